#include "shared/document/steps.h"

#include <cassert>

#include "shared/document/equations.h"
#include "shared/document/euler.h"
#include "shared/document/indirect_surface.h"
#include "shared/physics/compiled_steps.h"

namespace woodlouse::document {
namespace {

template <typename E>
std::unique_ptr<const physics::GroundSteps> with_equations(const AnySurface& ground, Integrator integrator,
                                                           const physics::StepRules& rules) {
  if (integrator == Integrator::kExplicitEuler) {
    return physics::with_main_forces<ExplicitEuler, E>(ground, rules);
  }
  return physics::with_main_forces<FalseEuler, E>(ground, rules);
}

}  // namespace

std::unique_ptr<const physics::GroundSteps> make_steps(const AnySurface& ground, state::Equations equations,
                                                       Integrator integrator,
                                                       const physics::StepRules& rules) {
  assert(equations != state::Equations::kExact);
  return equations == state::Equations::kLocalPlane ? with_equations<LocalPlane>(ground, integrator, rules)
                                                    : with_equations<AsPrinted>(ground, integrator, rules);
}

}  // namespace woodlouse::document
