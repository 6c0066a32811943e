#include "shared/physics/compiled_steps.h"

namespace woodlouse::physics {

std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::TiledGround& ground,
                                                     const StepRules& rules) {
#ifdef WOODLOUSE_FEW_STEPS
  static_cast<void>(ground), static_cast<void>(rules), assert(false);  // who has no files has no such ground
  return nullptr;
#else
  switch (rules.parameters.method) {
    case state::Method::kCheap:
      return with_main_forces<VerletQ>(ground, rules);
    case state::Method::kPrecise:
      return with_main_forces<Precise>(ground, rules);
    case state::Method::kStandard:
    case state::Method::kFalseEuler:  // not of these equations
      break;
  }
  return with_main_forces<Nystrom4>(ground, rules);
#endif
}

}  // namespace woodlouse::physics
