#include "bench/lab/methods/compiled_methods.h"
#include "shared/document/equations.h"
#include "shared/document/indirect_surface.h"
#include "shared/document/steps.h"

namespace woodlouse::lab {
namespace {

/// The document's equations by integrators that are not the document's.
template <typename E>
Steps by_others(const document::AnySurface& ground, Integrator integrator, const physics::StepRules& rules) {
  if (integrator == Integrator::kNystrom4) {
    return physics::with_main_forces<physics::Nystrom4, E>(ground, rules);
  }
  return own_steps<E>(ground, integrator, rules);
}

}  // namespace

Steps document_steps(const document::AnySurface& ground, Equations equations, Integrator integrator,
                     const physics::StepRules& rules) {
  const bool local_plane = equations == Equations::kLocalPlane;
  const auto its_own = local_plane ? state::Equations::kLocalPlane : state::Equations::kAsPrinted;
  switch (integrator) {
    case Integrator::kExplicitEuler:
      return document::make_steps(ground, its_own, document::Integrator::kExplicitEuler, rules);
    case Integrator::kFalseEuler:
      return document::make_steps(ground, its_own, document::Integrator::kFalseEuler, rules);
    default:
      return local_plane ? by_others<document::LocalPlane>(ground, integrator, rules)
                         : by_others<document::AsPrinted>(ground, integrator, rules);
  }
}

}  // namespace woodlouse::lab
