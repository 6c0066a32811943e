#include "bench/lab/methods/compiled_methods.h"

namespace woodlouse::lab {

Steps exact_steps(const terrain::BicubicSpline& ground, Integrator integrator,
                  const physics::StepRules& rules) {
  return steps_on_room_ground(ground, integrator, rules);
}

}  // namespace woodlouse::lab
