#include "shared/physics/compiled_steps.h"

namespace woodlouse::physics {

std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::FunctionSurface& ground,
                                                     const StepRules& rules) {
#ifdef WOODLOUSE_FEW_STEPS  // without cells the precise method is the standard one
  if (rules.parameters.method == state::Method::kCheap) return with_main_forces<VerletQ>(ground, rules);
  return with_main_forces<Nystrom4>(ground, rules);
#else
  return steps_with_every_force(ground, rules);
#endif
}

}  // namespace woodlouse::physics
