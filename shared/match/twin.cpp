#include "shared/match/twin.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "shared/map/map_world.h"
#include "shared/match/step_error.h"

namespace woodlouse::match {
namespace {

constexpr std::uint32_t kHalves = 2;

/// Whether nothing but a step moved it.
bool goes_on(const state::Louse& left, const state::Louse& found) {
  return left.position == found.position && left.velocity == found.velocity &&
         left.flight_z == found.flight_z && left.flight_vz == found.flight_vz;
}

bool same_thrust(const state::Louse& a, const state::Louse& b) {
  return a.thrust_kind == b.thrust_kind && a.thrust == b.thrust;
}

}  // namespace

Twin::Twin(const map::Map& map, double tick, state::Mode mode)
    : domain_(map.terrain->domain()),
      edges_(map::physics_of(map.definition, mode).edges),
      window_(static_cast<std::uint64_t>(kSeconds / tick + 0.5)),
      world_(map::make_world(map, tick / kHalves, mode)) {
  assert(tick > 0.0);
}

/// The twins of these lice, where they are or, of who comes or was moved, where he is; with his thrust.
void Twin::begin(std::span<const state::Louse> before) {
  std::map<state::LouseId, Pair> pairs;
  lice_.clear();
  for (const state::Louse& louse : before) {
    const auto known = pairs_.find(louse.id);
    Pair pair;
    lice_.push_back(louse);
    lice_.back().thrust_ticks = louse.thrust_ticks != 0 ? state::kHeld : 0;
    if (known != pairs_.end() && known->second.ticks < window_ && goes_on(known->second.game, louse)) {
      pair = known->second;
      lice_.back() = *world_.find(louse.id);
    }
    pairs.emplace(louse.id, pair);
  }
  pairs_ = std::move(pairs);
  world_.restore(lice_);
  for (const state::Louse& louse : before) {
    if (!same_thrust(*world_.find(louse.id), louse))
      world_.set_thrust(louse.id, {louse.thrust_kind, louse.thrust}, state::kHeld);
  }
}

void Twin::observe(std::span<const state::Louse> before, std::span<const state::Louse> after) {
  assert(before.size() == after.size());
  begin(before);
  for (std::uint32_t half = 0; half < kHalves; ++half) world_.step();
  for (const state::Louse& louse : after) {
    Pair& pair = pairs_.at(louse.id);
    pair.game = louse;
    if (++pair.ticks == window_) divergences_[louse.id].push_back(apart(louse.id)->metres);
  }
}

std::optional<Twin::Apart> Twin::apart(state::LouseId id) const {
  const auto pair = pairs_.find(id);
  if (pair == pairs_.end()) return std::nullopt;
  const state::Louse* const twin = world_.find(id);
  assert(twin != nullptr);
  return Apart{distance_over_map(pair->second.game.position, twin->position, domain_, edges_),
               pair->second.ticks};
}

}  // namespace woodlouse::match
