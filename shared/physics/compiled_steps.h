// GroundSteps of a ground, compiled for its integrator I, equations E and forces F. Included only where steps
// are compiled: steps_on_*.cpp, and beside them document/steps.cpp and the lab's own methods.
#pragma once

#include <cassert>
#include <memory>
#include <type_traits>
#include <utility>

#include "shared/physics/ground_steps.h"
#include "shared/physics/precise.h"
#include "shared/physics/rim.h"
#include "shared/physics/stepper.h"

namespace woodlouse::physics {

/// Whether few steps are compiled, for who loads them over a network (core.wasm): lanes for most maps alone,
/// and of forces the main choices. The bits are the same.
#ifdef WOODLOUSE_FEW_STEPS
inline constexpr bool kFewSteps = true;
inline constexpr std::size_t kLeastInLanes = 8;  // fewer are sooner stepped one by one than by two
#else
inline constexpr bool kFewSteps = false;
inline constexpr std::size_t kLeastInLanes = 1;
#endif

/// What is sampled in a call: the ground itself, but for big maps, where it remembers the tiles the call was
/// in. A ground of another room may have a surface_of() there.
template <typename S>
const S& surface_of(const S& ground) {
  return ground;
}
inline terrain::TiledBSpline surface_of(const terrain::TiledGround& ground) {
  return terrain::TiledBSpline(ground);
}

template <typename S, typename F, typename I, typename E>
class CompiledSteps final : public GroundSteps {
 public:
  CompiledSteps(const S& ground, const StepRules& rules) : ground_(ground), rules_(rules) {}

  void advance(std::span<state::Louse> lice, std::span<const std::uint32_t> moving, const BatchStep& batch,
               BatchLists& lists, StepCounters& counters,
               std::span<state::StepEvents> events) const override {
    assert(events.size() == lice.size());
    const auto& surface = surface_of(ground_);
    const OneStepper stepper(surface, rules_.parameters, rules_.walls, rules_.tick);
    if constexpr (kHasLanes) {
      if (batch.width > 0 && moving.size() >= kLeastInLanes)
        return advance_batched(stepper, lice, moving, batch, lists, counters, events);
    }
    counters.left += moving.size();
    for (const std::uint32_t index : moving) stepper.advance(lice[index], counters, events[index]);
  }

  [[nodiscard]] bool holds(const state::Louse& louse) const override {
    const auto& surface = surface_of(ground_);
    return OneStepper(surface, rules_.parameters, rules_.walls, rules_.tick).holds(louse);
  }

 private:
  using Surface = std::remove_cvref_t<decltype(surface_of(std::declval<const S&>()))>;
  using OneStepper = Stepper<Surface, F, E, I>;
  static constexpr bool kHasLanes =
      E::kExact && std::is_same_v<I, Nystrom4> && (!kFewSteps || (F::friction && !F::central)) &&
      (std::is_same_v<S, terrain::BicubicSpline> || (!kFewSteps && std::is_same_v<S, terrain::PlaneSurface>));

  void advance_batched(const OneStepper& stepper, std::span<state::Louse> lice,
                       std::span<const std::uint32_t> moving, const BatchStep& batch, BatchLists& lists,
                       StepCounters& counters, std::span<state::StepEvents> events) const {
    // Whoever leaves the interior takes the scalar step, which knows of walls and seams.
    const terrain::Rectangle interior = Rim(rules_.walls, rules_.parameters.edges).interior();
    BatchContext context{
        {}, {}, rules_.parameters, interior, rules_.tick, stepper.rules(), ground_.cell(), batch.go_on_few};
    if constexpr (std::is_same_v<S, terrain::PlaneSurface>) {
      const terrain::Rectangle domain = ground_.domain();
      context.plane = {ground_.height(), {domain.x_min, domain.y_min}, ground_.slope()};
    } else {
      context.spline = ground_.view();
    }
    counters.louse_steps += moving.size();
    batch.advance_of(moving.size())(context, lice.data(), moving, lists, counters);
    counters.left += lists.left.size();
    for (const LouseTick& tick : lists.left) {
      stepper.finish(lice[tick.index], tick.remaining, static_cast<int>(tick.pieces), counters,
                     events[tick.index]);
    }
  }

  const S& ground_;
  StepRules rules_;
};

/// Steps by a few choices of forces, for what is rarely run: friction, which has rules of its own, is
/// compiled out, and all of them where energy is kept.
template <typename I, typename E = SurfaceEquations, typename S>
std::unique_ptr<const GroundSteps> with_main_forces(const S& ground, const StepRules& rules) {
  const auto make = [&]<typename F>(F) -> std::unique_ptr<const GroundSteps> {
    return std::make_unique<const CompiledSteps<S, F, I, E>>(ground, rules);
  };
  if (rules.parameters.central_gravity > 0.0) return make(Forces<true, true, true, true>{});
  if constexpr (E::kExact) {
    if (conserves_energy(rules.parameters) && !(rules.parameters.thrust_max > 0.0))
      return make(Forces<false, false, false>{});
  }
  return rules.parameters.friction > 0.0 ? make(Forces<true, true, true>{})
                                         : make(Forces<true, false, true>{});
}

/// The same by every combination of the forces that a map may leave out and that earns it.
template <typename I, typename S>
std::unique_ptr<const GroundSteps> with_forces(const S& ground, const StepRules& rules) {
  if constexpr (kFewSteps) {
    return with_main_forces<I>(ground, rules);
  } else {
    const state::Parameters& p = rules.parameters;
    const auto make = [&]<typename F>(F) -> std::unique_ptr<const GroundSteps> {
      return std::make_unique<const CompiledSteps<S, F, I, SurfaceEquations>>(ground, rules);
    };
    if (p.central_gravity > 0.0)
      return make(Forces<true, true, true, true>{});  // what is 0 of the others does nothing
    if (p.friction > 0.0)
      return p.thrust_max > 0.0 ? make(ForcesWithAnyDrag<true, true>{})
                                : make(ForcesWithAnyDrag<true, false>{});
    if (p.thrust_max > 0.0) return make(ForcesWithAnyDrag<false, true>{});
    return p.drag > 0.0 ? make(Forces<true, false, false>{}) : make(Forces<false, false, false>{});
  }
}

/// For the grounds of most maps: the default method in with_forces, the others in the main ones.
template <typename S>
std::unique_ptr<const GroundSteps> steps_with_every_force(const S& ground, const StepRules& rules) {
  switch (rules.parameters.method) {
    case state::Method::kCheap:
      return with_main_forces<VerletQ>(ground, rules);
    case state::Method::kPrecise:
      return with_main_forces<Precise>(ground, rules);
    case state::Method::kStandard:
    case state::Method::kFalseEuler:  // not of these equations
      break;
  }
  return with_forces<Nystrom4>(ground, rules);
}

}  // namespace woodlouse::physics
