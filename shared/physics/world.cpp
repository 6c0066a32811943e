#include "shared/physics/world.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <variant>

#include "shared/physics/precise.h"
#include "shared/physics/stepper.h"

namespace woodlouse::physics {
namespace {

/// Calls use(Forces<...>{}) with the forces these parameters have.
template <typename Use>
void with_forces(const Parameters& p, const Use& use) {
  if (p.central_gravity > 0.0) return use(Forces<true, true, true, true>{});  // what is 0 of the others does nothing
  const auto choose_thrust = [&]<bool kDrag, bool kFriction>() {
    p.thrust_max > 0.0 ? use(Forces<kDrag, kFriction, true>{}) : use(Forces<kDrag, kFriction, false>{});
  };
  const auto choose_friction = [&]<bool kDrag>() {
    p.friction > 0.0 ? choose_thrust.template operator()<kDrag, true>()
                     : choose_thrust.template operator()<kDrag, false>();
  };
  p.drag > 0.0 ? choose_friction.template operator()<true>() : choose_friction.template operator()<false>();
}

/// The same with fewer choices, for methods that are rarely run: only friction, which has rules of its own, is
/// compiled out.
template <typename Use>
void with_main_forces(const Parameters& p, const Use& use) {
  if (p.central_gravity > 0.0) return use(Forces<true, true, true, true>{});
  p.friction > 0.0 ? use(Forces<true, true, true>{}) : use(Forces<true, false, true>{});
}

/// A resting louse is visited only while its thrust has an end.
bool must_be_visited(const Louse& louse) {
  return louse.phase != Phase::kResting || (louse.thrust_ticks != 0 && louse.thrust_ticks != kHeld);
}

template <typename Stepper>
Phase phase_of(const Stepper& stepper, const Louse& louse) {
  return stepper.holds(louse) ? Phase::kResting : Phase::kMoving;
}

void clear_thrust(Louse& louse) {
  louse.thrust = {};
  louse.thrust_kind = ThrustKind::kNone;
  louse.thrust_ticks = 0;
}

}  // namespace

World::World(std::shared_ptr<const terrain::Terrain> terrain, const Parameters& parameters, double step)
    : World(terrain, parameters, step, terrain->domain()) {}

World::World(std::shared_ptr<const terrain::Terrain> terrain, const Parameters& parameters, double step,
             const terrain::Rectangle& walls)
    : terrain_(std::move(terrain)), parameters_(parameters), step_(step), walls_(walls) {
  assert(terrain_ != nullptr && step > 0.0);
  use(best_instruction_set());
}

void World::use(InstructionSet set) {
  assert(is_available(set));
  // Flight, central gravity and the other methods are not in the lanes.
  const bool has_lanes = parameters_.method == Method::kStandard && parameters_.contact == SurfaceContact::kBilateral && !(parameters_.central_gravity > 0.0) && std::holds_alternative<terrain::BicubicSpline>(terrain_->surface());
  batch_ = has_lanes ? find_batch_step(set, parameters_.drag > 0.0, parameters_.friction > 0.0, parameters_.thrust_max > 0.0)
                     : BatchStep{};
}

template <typename Use>
void World::with_stepper(const Use& use) const {
  std::visit(
      [&]<terrain::Surface S>(const S& surface) {
        const auto with_method = [&]<typename I>(I) {
          with_main_forces(parameters_, [&]<typename F>(F) {
            use(Stepper<S, F, SurfaceEquations, I>(surface, parameters_, walls_, step_));
          });
        };
        switch (parameters_.method) {
          case Method::kCheap: return with_method(VerletQ{});
          case Method::kPrecise: return with_method(Precise{});
          case Method::kStandard: break;
        }
        with_forces(parameters_, [&]<typename F>(F) { use(Stepper<S, F>(surface, parameters_, walls_, step_)); });
      },
      terrain_->surface());
}

std::size_t World::index_of(LouseId id) const {
  const auto at = std::lower_bound(lice_.begin(), lice_.end(), id,
                                   [](const Louse& louse, LouseId wanted) { return louse.id < wanted; });
  return at != lice_.end() && at->id == id ? static_cast<std::size_t>(at - lice_.begin()) : lice_.size();
}

const Louse* World::find(LouseId id) const {
  const std::size_t index = index_of(id);
  return index < lice_.size() ? &lice_[index] : nullptr;
}

BatchContext World::batch_context() const {
  const auto& spline = std::get<terrain::BicubicSpline>(terrain_->surface());
  return {spline.view(), parameters_, walls_, step_, SubStepRules(parameters_, spline.cell(), step_)};
}

void World::settle(Louse& louse) {
  with_stepper([&](const auto& stepper) { louse.phase = phase_of(stepper, louse); });
}

void World::insert(const Louse& louse) {
  assert(find(louse.id) == nullptr);
  const auto at = std::lower_bound(lice_.begin(), lice_.end(), louse.id,
                                   [](const Louse& a, LouseId id) { return a.id < id; });
  Louse& placed = *lice_.insert(at, louse);
  placed.position.x = std::clamp(placed.position.x, walls_.x_min, walls_.x_max);
  placed.position.y = std::clamp(placed.position.y, walls_.y_min, walls_.y_max);
  if (placed.phase != Phase::kFlying) settle(placed);
  awake_is_stale_ = true;
}

bool World::erase(LouseId id) {
  const std::size_t index = index_of(id);
  if (index == lice_.size()) return false;
  lice_.erase(lice_.begin() + static_cast<std::ptrdiff_t>(index));
  awake_is_stale_ = true;
  return true;
}

bool World::set_thrust(LouseId id, const Thrust& thrust, std::uint32_t ticks) {
  const std::size_t index = index_of(id);
  if (index == lice_.size()) return false;
  Louse& louse = lice_[index];
  const bool was_visited = must_be_visited(louse);
  louse.thrust = thrust.value;
  louse.thrust_kind = thrust.kind;
  louse.thrust_ticks = ticks;
  if (thrust.kind == ThrustKind::kNone || ticks == 0) clear_thrust(louse);
  if (louse.phase == Phase::kResting) settle(louse);
  if (must_be_visited(louse) != was_visited) awake_is_stale_ = true;
  return true;
}

void World::collect_awake() {
  awake_.clear();
  for (std::size_t i = 0; i < lice_.size(); ++i) {
    if (must_be_visited(lice_[i])) awake_.push_back(static_cast<std::uint32_t>(i));
  }
  awake_is_stale_ = false;
}

template <typename Stepper>
void World::advance_all(const Stepper& stepper) {
  std::array<Louse*, 8> lanes{};
  int filled = 0;
  const auto width = batch_.width;
  if (width == 0) {
    for (const std::uint32_t index : awake_) {
      if (lice_[index].phase != Phase::kResting) stepper.advance(lice_[index], counters_);
    }
    return;
  }
  const BatchContext context = batch_context();
  const auto flush = [&](unsigned done) {
    for (int l = 0; l < filled; ++l) {
      if ((done >> l & 1u) != 0) {
        ++counters_.louse_steps;
        ++counters_.sub_steps;
      } else {
        stepper.advance(*lanes[static_cast<std::size_t>(l)], counters_);
      }
    }
    filled = 0;
  };
  for (const std::uint32_t index : awake_) {
    if (lice_[index].phase == Phase::kResting) continue;
    lanes[static_cast<std::size_t>(filled++)] = &lice_[index];
    if (filled == width) flush(batch_.advance(context, lanes.data()));
  }
  flush(0);
}

void World::step() {
  if (awake_is_stale_) collect_awake();
  if (awake_.empty()) return;
  bool changed = false;
  with_stepper([&](const auto& stepper) {
    advance_all(stepper);
    for (const std::uint32_t index : awake_) {
      Louse& louse = lice_[index];
      if (louse.thrust_ticks != 0 && louse.thrust_ticks != kHeld && --louse.thrust_ticks == 0) {
        clear_thrust(louse);
        if (louse.phase == Phase::kResting) louse.phase = phase_of(stepper, louse);
      }
      changed |= !must_be_visited(louse);
    }
  });
  if (changed) awake_is_stale_ = true;
}

}  // namespace woodlouse::physics
