// The physics: whatever map a server takes and whatever its players do, a louse stays finite and on the map,
// makes no energy, costs a bounded number of looks at the surface, rests where it rests, and is the same bit
// for bit by every instruction set, alone or among others, and in a world that was restored.
//
// Input: physics_game.h.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/map/map_text.h"
#include "shared/map/map_world.h"
#include "shared/physics/integrators.h"
#include "shared/physics/precise.h"
#include "tests/fuzz/physics_energy.h"
#include "tests/fuzz/physics_game.h"
#include "tests/fuzz/physics_progress.h"
#include "tests/fuzz/property.h"

using namespace woodlouse;
using fuzz::demand;

namespace {

constexpr std::size_t kMaxLice = 8;

/// Of a louse in a tick: kMaxSubSteps pieces and one that is the rest.
constexpr std::uint64_t kMaxPieces = static_cast<std::uint64_t>(physics::kMaxSubSteps) + 1;

/// Likewise of looks: each piece's start and step; what ends in an event (at most 64 do) repeats its step to
/// find a wall (60 times) and the moment of a take-off (51). The air has no samples.
constexpr std::uint64_t most_samples(const state::Parameters& parameters) {
  const state::Method method = parameters.method;
  const auto step =
      static_cast<std::uint64_t>(method == state::Method::kCheap     ? physics::VerletQ::kSamples
                                 : method == state::Method::kPrecise ? physics::Precise::kSamples
                                                                     : physics::Nystrom4::kSamples);
  constexpr std::uint64_t kMaxEvents = 64, kWallSearch = 60, kTakeOffSearch = 51;
  const std::uint64_t asked = parameters.tolerance > 0.0 ? physics::kLobattoSamples : 0;
  return kMaxPieces * (1 + step + asked) + kMaxEvents * (kWallSearch + kTakeOffSearch) * step;
}

bool same_bytes(const state::Louse& a, const state::Louse& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool same_bytes(std::span<const state::Louse> a, std::span<const state::Louse> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

std::string text_of(const state::Louse& louse) {
  std::string text = core::joined({"louse ", std::to_string(louse.id), " phase ",
                                   std::to_string(static_cast<std::uint32_t>(louse.phase))});
  for (const double value :
       {louse.position.x, louse.position.y, louse.velocity.x, louse.velocity.y, louse.heading.x,
        louse.heading.y, louse.thrust.x, louse.thrust.y, louse.flight_z, louse.flight_vz, louse.distance}) {
    text.append(" ").append(json::double_text(value));
  }
  return text;
}

/// The same game in several worlds, each of which must have the same lice.
class Table {
 public:
  Table(const map::Map& map, double step)
      : map_(map), step_(step), alone_(map::make_world(map, step)), energy_(*map.terrain, parameters()) {
    for (const auto set : {physics::InstructionSet::kScalar, physics::InstructionSet::kAvx2,
                           physics::InstructionSet::kAvx512}) {
      if (!physics::is_available(set)) continue;
      worlds_.push_back(map::make_world(map, step));
      worlds_.back().use(set);
    }
  }

  void insert(const fuzz::Arrival& arrival) {
    if (lice().size() == kMaxLice) return;
    const terrain::Rectangle& domain = map_.terrain->domain();
    state::Louse louse;
    louse.id = next_id_++;
    louse.position = {domain.x_min + arrival.place.x * (domain.x_max - domain.x_min),
                      domain.y_min + arrival.place.y * (domain.y_max - domain.y_min)};
    louse.velocity = arrival.velocity;
    louse.heading = arrival.heading;
    for (physics::World& world : worlds_) world.insert(louse);
  }

  void perform(const fuzz::Deed& deed) {
    if (deed.kind == fuzz::DeedKind::kComes) return insert(deed.arrival);
    if (lice().empty()) return;
    const state::LouseId id = lice()[deed.which % lice().size()].id;
    for (physics::World& world : worlds_) {
      const bool is_known = deed.kind == fuzz::DeedKind::kGoes
                                ? world.erase(id)
                                : world.set_thrust(id, deed.thrust, deed.ticks);
      demand(is_known, "every world knows its lice");
    }
  }

  /// One more world goes on from here.
  void restore() {
    worlds_.push_back(map::make_world(map_, step_));
    worlds_.back().restore(worlds_.front().lice());
  }

  /// For the fuzzer, at the end.
  void note_events() const {
    fuzz::progress.note_events(*map_.terrain, parameters(), worlds_.front().counters());
  }

  void step() {
    const std::vector<state::Louse> before(lice().begin(), lice().end());
    for (physics::World& world : worlds_) {
      world.step();
      demand(same_bytes(world.lice(), lice()), "every world has the same lice", difference(world));
    }
    for (std::size_t k = 0; k < before.size(); ++k) {
      check(before[k], lice()[k]);
      check_alone(before[k], lice()[k]);
    }
  }

 private:
  [[nodiscard]] const state::Parameters& parameters() const { return map_.definition.physics; }
  [[nodiscard]] std::span<const state::Louse> lice() const { return worlds_.front().lice(); }

  [[nodiscard]] std::string difference(const physics::World& world) const {
    for (std::size_t k = 0; k < lice().size() && k < world.lice().size(); ++k) {
      if (!same_bytes(lice()[k], world.lice()[k])) return told(lice()[k], world.lice()[k]);
    }
    return map_.canonical;
  }

  [[nodiscard]] std::string told(const state::Louse& a, const state::Louse& b) const {
    return core::joined({text_of(a), "\nthen: ", text_of(b), "\nsteps of ", json::double_text(step_),
                         " s on: ", map_.canonical});
  }

  void check(const state::Louse& before, const state::Louse& after) const {
    const auto must = [&](bool holds, std::string_view what) {
      if (!holds) demand(false, what, told(before, after));
    };
    for (const double value :
         {after.position.x, after.position.y, after.velocity.x, after.velocity.y, after.heading.x,
          after.heading.y, after.thrust.x, after.thrust.y, after.flight_z, after.flight_vz, after.distance}) {
      must(std::isfinite(value), "a louse's state stays finite");
    }
    must(map_.terrain->domain().contains(after.position.x, after.position.y), "a louse stays on the map");
    must(std::abs(std::sqrt(core::dot(after.heading, after.heading)) - 1.0) <= 1e-9,
         "a heading is a unit vector");
    must(after.distance >= before.distance, "the way only grows");
    switch (after.phase) {
      case state::Phase::kMoving:
        break;
      case state::Phase::kResting:
        must(after.velocity == core::Vec2{}, "who rests has no velocity");
        break;
      case state::Phase::kFlying:
        must(parameters().contact == state::SurfaceContact::kUnilateral, "nobody leaves a bilateral contact");
        break;
      default:
        must(false, "a phase is one of the three");
    }
    must(after.phase == state::Phase::kFlying || (after.flight_z == 0.0 && after.flight_vz == 0.0),
         "who is on the ground has no flight");
    if (before.phase == state::Phase::kResting) check_rest(before, after);
    const double energy = energy_.of(after);
    const double most = energy_.most_after(before, step_);
    fuzz::progress.note_gain(parameters().method, energy_.gained_share(before, energy, step_));
    if (energy <= most) return;
    const double old = energy_.of(before);
    demand(false, "a tick makes no energy",
           core::joined({json::double_text(old), " to ", json::double_text(energy), ", at most ",
                         json::double_text(most), "; above the lowest place it was ",
                         json::double_text(energy_.above_floor(before)), "\n", told(before, after)}));
  }

  void check_rest(const state::Louse& before, const state::Louse& after) const {
    const bool is_same = std::memcmp(&before.position, &after.position, sizeof before.position) == 0 &&
                         std::memcmp(&before.heading, &after.heading, sizeof before.heading) == 0 &&
                         fuzz::same_bits(before.distance, after.distance) && after.velocity == core::Vec2{};
    demand(is_same, "who rests stays where he is", is_same ? std::string() : told(before, after));
  }

  /// Lice don't touch each other; and what one of them costs.
  void check_alone(const state::Louse& before, const state::Louse& after) {
    const physics::StepCounters earlier = alone_.counters();
    alone_.restore({&before, 1});
    alone_.step();
    const state::Louse& louse = alone_.lice().front();
    if (!same_bytes(louse, after)) demand(false, "a louse alone is as among others", told(after, louse));
    const std::uint64_t pieces = alone_.counters().sub_steps - earlier.sub_steps;
    const std::uint64_t samples = alone_.counters().samples - earlier.samples;
    if (pieces > kMaxPieces) demand(false, "a tick's pieces are few", count_text(pieces, before, after));
    if (samples > most_samples(parameters()))
      demand(false, "a tick's samples are few", count_text(samples, before, after));
  }

  [[nodiscard]] std::string count_text(std::uint64_t count, const state::Louse& before,
                                       const state::Louse& after) const {
    return core::joined({std::to_string(count), "\n", told(before, after)});
  }

  const map::Map& map_;
  double step_;
  std::vector<physics::World> worlds_;  ///< the first one's lice are the game's
  physics::World alone_;                ///< steps one louse at a time
  fuzz::EnergyLaw energy_;
  state::LouseId next_id_ = 1;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Game game = fuzz::read_game({data, size});
  const auto map = map::parse_map(game.map, "map.json", nullptr);
  demand(map.has_value(), "a game has a map that is taken", map ? game.map : map.error().text());
  Table table(**map, game.step);
  for (const fuzz::Arrival& arrival : game.arrivals) table.insert(arrival);
  for (std::size_t tick = 0; tick < game.ticks.size(); ++tick) {
    if (tick == game.ticks.size() / 2) table.restore();
    for (const fuzz::Deed& deed : game.ticks[tick]) table.perform(deed);
    table.step();
  }
  table.note_events();
  return 0;
}
