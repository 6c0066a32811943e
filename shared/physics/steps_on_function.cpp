#include "shared/physics/compiled_steps.h"

namespace woodlouse::physics {

std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::FunctionSurface& ground,
                                                     const StepRules& rules) {
  return steps_with_every_force(ground, rules);
}

}  // namespace woodlouse::physics
