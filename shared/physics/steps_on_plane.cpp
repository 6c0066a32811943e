#include "shared/physics/compiled_steps.h"

namespace woodlouse::physics {

std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::PlaneSurface& ground,
                                                     const StepRules& rules) {
  // Nothing to split: the precise method is the standard one.
  if (rules.parameters.method == state::Method::kCheap) return with_main_forces<VerletQ>(ground, rules);
  return with_forces<Nystrom4>(ground, rules);
}

}  // namespace woodlouse::physics
