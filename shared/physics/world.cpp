#include "shared/physics/world.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "shared/physics/ground_steps.h"
#include "shared/physics/heading.h"
#include "shared/physics/rim.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {
namespace {

/// Who must visit a louse in a step.
enum class List {
  kMoving,
  kWaiting,  ///< at rest with a thrust that has an end
  kNone,
};

List list_of(const state::Louse& louse) {
  if (louse.phase != state::Phase::kResting) return List::kMoving;
  return louse.thrust_ticks != 0 && louse.thrust_ticks != state::kHeld ? List::kWaiting : List::kNone;
}

/// The lanes' ground for a map, if they can step it: the other methods are not in them.
std::optional<BatchGround> batch_ground(const terrain::Terrain& terrain, const state::Parameters& p) {
  if (p.equations != state::Equations::kExact) return std::nullopt;
  if (p.method == state::Method::kCheap) return std::nullopt;
  if (std::holds_alternative<terrain::PlaneSurface>(terrain.surface()))
    return BatchGround::kPlane;  // nothing to split
  return p.method == state::Method::kStandard &&
                 std::holds_alternative<terrain::BicubicSpline>(terrain.surface())
             ? std::optional(BatchGround::kBicubicSpline)
             : std::nullopt;
}

std::unique_ptr<const GroundSteps> exact_steps(const terrain::Terrain& terrain, const StepRules& rules) {
  assert(rules.parameters.equations == state::Equations::kExact);
  return std::visit(
      [&]<typename S>(const S& ground) -> std::unique_ptr<const GroundSteps> {
        if constexpr (std::is_same_v<S, terrain::SharedSurface>) {
          assert(false);
          return nullptr;
        } else {
          return make_ground_steps(ground, rules);
        }
      },
      terrain.surface());
}

/// Whether its heading is a state of its own, as drive_of() has it.
bool turns_heading(const state::Louse& louse, const state::Parameters& p) {
  return p.equations == state::Equations::kExact && p.thrust_max > 0.0 &&
         louse.phase != state::Phase::kFlying && louse.thrust_kind == state::ThrustKind::kAlongHeading &&
         louse.thrust.x > 0.0;
}

void clear_thrust(state::Louse& louse) {
  louse.thrust = {};
  louse.thrust_kind = state::ThrustKind::kNone;
  louse.thrust_ticks = 0;
}

}  // namespace

World::World(std::shared_ptr<const terrain::Terrain> terrain, const state::Parameters& parameters,
             double step)
    : World(terrain, parameters, step, terrain->domain()) {}

World::World(std::shared_ptr<const terrain::Terrain> terrain, const state::Parameters& parameters,
             double step, const terrain::Rectangle& walls)
    : World(terrain, parameters, step, walls, exact_steps(*terrain, {parameters, walls, step})) {}

World::World(std::shared_ptr<const terrain::Terrain> terrain, const state::Parameters& parameters,
             double step, const terrain::Rectangle& walls, std::shared_ptr<const GroundSteps> steps)
    : terrain_(std::move(terrain)),
      parameters_(parameters),
      step_(step),
      walls_(walls),
      ground_steps_(std::move(steps)) {
  assert(terrain_ != nullptr && ground_steps_ != nullptr && step > 0.0);
  use(best_instruction_set());
}

void World::use(InstructionSet set) {
  assert(is_available(set));
  const std::optional<BatchGround> ground = batch_ground(*terrain_, parameters_);
  const BatchForces forces{parameters_.drag > 0.0, parameters_.friction > 0.0, parameters_.thrust_max > 0.0,
                           parameters_.central_gravity > 0.0};
  batch_ = ground ? find_batch_step(set, *ground, forces) : BatchStep{};
}

void World::use(std::shared_ptr<core::Team> team) {
  team_ = std::move(team);
  lists_are_stale_ = true;
}

std::size_t World::index_of(state::LouseId id) const {
  const auto at =
      std::lower_bound(lice_.begin(), lice_.end(), id,
                       [](const state::Louse& louse, state::LouseId wanted) { return louse.id < wanted; });
  return at != lice_.end() && at->id == id ? static_cast<std::size_t>(at - lice_.begin()) : lice_.size();
}

const state::Louse* World::find(state::LouseId id) const {
  const std::size_t index = index_of(id);
  return index < lice_.size() ? &lice_[index] : nullptr;
}

void World::settle(state::Louse& louse) const {
  louse.phase = ground_steps_->holds(louse) ? state::Phase::kResting : state::Phase::kMoving;
}

void World::restore(std::span<const state::Louse> lice) {
  lice_.assign(lice.begin(), lice.end());
  events_.assign(lice.size(), 0);
  lists_are_stale_ = true;
  note_changes_from(0);
}

void World::forget_changes() { std::fill(changed_blocks_.begin(), changed_blocks_.end(), std::uint8_t{0}); }

/// Who comes or goes moves all behind him to other places.
void World::note_changes_from(std::size_t index) {
  assert(index <= lice_.size());
  changed_blocks_.resize(state::block_count(lice_.size()));
  const std::size_t block = std::min(index / state::kBlockLice, changed_blocks_.size());
  std::fill(changed_blocks_.begin() + static_cast<std::ptrdiff_t>(block), changed_blocks_.end(),
            std::uint8_t{1});
}

core::Vec2 World::in_domain(core::Vec2 position) const {
  const Rim rim(walls_, parameters_.edges);
  if (!rim.wraps())
    return {std::clamp(position.x, walls_.x_min, walls_.x_max),
            std::clamp(position.y, walls_.y_min, walls_.y_max)};
  rim.carry_home(position);
  return position;
}

void World::insert(const state::Louse& louse) {
  assert(find(louse.id) == nullptr);
  const auto at = std::lower_bound(lice_.begin(), lice_.end(), louse.id,
                                   [](const state::Louse& a, state::LouseId id) { return a.id < id; });
  events_.insert(events_.begin() + (at - lice_.begin()), state::StepEvents{0});
  state::Louse& placed = *lice_.insert(at, louse);
  placed.position = in_domain(placed.position);
  if (placed.phase != state::Phase::kFlying) settle(placed);
  lists_are_stale_ = true;
  note_changes_from(static_cast<std::size_t>(&placed - lice_.data()));
}

bool World::erase(state::LouseId id) {
  const std::size_t index = index_of(id);
  if (index == lice_.size()) return false;
  lice_.erase(lice_.begin() + static_cast<std::ptrdiff_t>(index));
  events_.erase(events_.begin() + static_cast<std::ptrdiff_t>(index));
  lists_are_stale_ = true;
  note_changes_from(index);
  return true;
}

bool World::set_thrust(state::LouseId id, const state::Thrust& thrust, std::uint32_t ticks) {
  const std::size_t index = index_of(id);
  if (index == lice_.size()) return false;
  state::Louse& louse = lice_[index];
  const List before = list_of(louse);
  louse.thrust = thrust.value;
  louse.thrust_kind = thrust.kind;
  louse.thrust_ticks = ticks;
  if (thrust.kind == state::ThrustKind::kNone || ticks == 0) clear_thrust(louse);
  if (louse.phase == state::Phase::kResting) settle(louse);
  if (list_of(louse) != before) lists_are_stale_ = true;
  note_change(index);
  return true;
}

bool World::set_motion(state::LouseId id, core::Vec2 position, core::Vec2 velocity) {
  const std::size_t index = index_of(id);
  if (index == lice_.size()) return false;
  set_motion_at(index, position, velocity);
  return true;
}

void World::set_motion_at(std::size_t index, core::Vec2 position, core::Vec2 velocity) {
  const core::Vec2 nothing = (position - position) + (velocity - velocity);
  assert(nothing == core::Vec2{} && index < lice_.size());  // finite
  state::Louse& louse = lice_[index];
  const List before = list_of(louse);
  louse.position = in_domain(position);
  louse.velocity = velocity;
  if (!turns_heading(louse, parameters_) && core::dot(velocity, velocity) > kStandstill2)
    louse.heading = unit(velocity);
  if (louse.phase != state::Phase::kFlying) settle(louse);
  if (list_of(louse) != before) lists_are_stale_ = true;
  note_change(index);
}

void World::collect() {
  moving_.clear();
  waiting_.clear();
  for (std::size_t i = 0; i < lice_.size(); ++i) {
    const List list = list_of(lice_[i]);
    if (list == List::kMoving) moving_.push_back(static_cast<std::uint32_t>(i));
    if (list == List::kWaiting) waiting_.push_back(static_cast<std::uint32_t>(i));
  }
  cut();
  lists_are_stale_ = false;
}

/// Into parts of as many moving lice each as blocks allow.
void World::cut() {
  parts_.resize(core::parts_for(team_.get(), moving_.size(), kMemberLice));
  std::size_t moving = 0, waiting = 0;
  const auto place_of = [](const std::vector<std::uint32_t>& list, std::size_t index) {
    return static_cast<std::size_t>(std::lower_bound(list.begin(), list.end(), index) - list.begin());
  };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Part& part = parts_[k];
    part.moving_begin = moving;
    part.waiting_begin = waiting;
    if (k + 1 == parts_.size()) {
      moving = moving_.size();
      waiting = waiting_.size();
    } else {
      const std::size_t next = moving_[(k + 1) * moving_.size() / parts_.size()];
      const std::size_t border = next / state::kBlockLice * state::kBlockLice;
      moving = place_of(moving_, border);
      waiting = place_of(waiting_, border);
    }
    part.moving_end = moving;
    part.waiting_end = waiting;
  }
}

void World::step() {
  std::fill(events_.begin(), events_.end(), state::StepEvents{0});
  if (lists_are_stale_) collect();
  if (moving_.empty() && waiting_.empty()) return;
  // Shared by the threads: the lists, the ground, its steps and the batch, which nobody writes but a big
  // map's tiles (tile_store.h), and lice_, events_ and changed_blocks_, of which each writes what is its
  // part's.
  core::run_parts(team_.get(), parts_.size(), [this](std::size_t k) { step(parts_[k]); });
  for (const Part& part : parts_) {
    counters_ += part.counters;
    lists_are_stale_ |= part.lists_are_stale;
  }
}

void World::step(Part& part) {
  part.counters = {};
  part.lists_are_stale = false;
  const auto moving = std::span(moving_).subspan(part.moving_begin, part.moving_end - part.moving_begin);
  const auto waiting = std::span(waiting_).subspan(part.waiting_begin, part.waiting_end - part.waiting_begin);
  if (!moving.empty()) ground_steps_->advance(lice_, moving, batch_, part.lists, part.counters, events_);
  const auto count_down = [&](std::span<const std::uint32_t> list, List own) {
    for (const std::uint32_t index : list) {
      state::Louse& louse = lice_[index];
      note_change(index);
      if (louse.thrust_ticks != 0 && louse.thrust_ticks != state::kHeld && --louse.thrust_ticks == 0) {
        clear_thrust(louse);
        if (louse.phase == state::Phase::kResting) settle(louse);
      }
      part.lists_are_stale |= list_of(louse) != own;
    }
  };
  count_down(moving, List::kMoving);
  count_down(waiting, List::kWaiting);
}

}  // namespace woodlouse::physics
