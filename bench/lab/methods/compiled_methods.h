// The methods by which laboratory.h steps lice on one kind of ground, compiled: included only by the
// steps_*.cpp, a file for each kind, so that they build side by side. What a room steps with (nystrom4,
// verlet_q, precise over the grounds of terrain.h) and what the document has is compiled where it belongs.
#pragma once

#include "bench/lab/methods/integrators.h"
#include "bench/lab/methods/steps.h"
#include "shared/document/euler.h"
#include "shared/physics/compiled_steps.h"

namespace woodlouse::lab {

/// The lab's own integrators with equations E; null: it is not one of them.
template <typename E, typename S>
Steps own_steps(const S& ground, Integrator integrator, const physics::StepRules& rules) {
  switch (integrator) {
    case Integrator::kRungeKutta4:
      return physics::with_main_forces<RungeKutta4, E>(ground, rules);
    case Integrator::kDormandPrince5:
      return physics::with_main_forces<DormandPrince5, E>(ground, rules);
    case Integrator::kVerletQ4:
      if constexpr (E::kExact) return physics::with_main_forces<VerletQ4, E>(ground, rules);
      return nullptr;
    default:
      return nullptr;
  }
}

/// The same with the exact equations, and the document's integrators with them.
template <typename S>
Steps own_exact_steps(const S& ground, Integrator integrator, const physics::StepRules& rules) {
  switch (integrator) {
    case Integrator::kExplicitEuler:
      return physics::with_main_forces<document::ExplicitEuler>(ground, rules);
    case Integrator::kFalseEuler:
      return physics::with_main_forces<document::FalseEuler>(ground, rules);
    default:
      return own_steps<physics::SurfaceEquations>(ground, integrator, rules);
  }
}

/// Every integrator with the exact equations over a ground that rooms have too.
template <typename S>
Steps steps_on_room_ground(const S& ground, Integrator integrator, const physics::StepRules& rules) {
  const auto method = room_method(integrator);
  if (!method) return own_exact_steps(ground, integrator, rules);
  physics::StepRules of_room = rules;
  of_room.parameters.method = *method;
  return physics::make_ground_steps(ground, of_room);
}

}  // namespace woodlouse::lab
