#include "bench/lab/methods/compiled_methods.h"
#include "shared/document/indirect_surface.h"

namespace woodlouse::lab {

Steps exact_steps(const document::AnySurface& ground, Integrator integrator,
                  const physics::StepRules& rules) {
  switch (integrator) {
    case Integrator::kNystrom4:
      return physics::with_main_forces<physics::Nystrom4>(ground, rules);
    case Integrator::kVerletQ:
      return physics::with_main_forces<physics::VerletQ>(ground, rules);
    default:
      return own_exact_steps(ground, integrator, rules);
  }
}

}  // namespace woodlouse::lab
