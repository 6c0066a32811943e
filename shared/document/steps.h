// The document's own stepping: its equations (equations.h) by its Euler methods (euler.h) over any surface of
// the catalogue, in the form in which a world has its steps (physics/ground_steps.h). They run bare, as
// printed: no sub-steps, nobody sticks and nobody rests; walls bounce and seams wrap as everywhere.
#pragma once

#include <memory>

#include "shared/document/surface_catalogue.h"
#include "shared/physics/ground_steps.h"

namespace woodlouse::document {

enum class Integrator {
  kExplicitEuler,
  kFalseEuler,  ///< the document's choice
};

/// Every combination exists but with the exact equations, which are physics'. `ground` must outlive the
/// steps. Without lanes: REQUIRES a batch of width 0. Of a surface without a Hessian nothing but height and
/// gradient is used.
std::unique_ptr<const physics::GroundSteps> make_steps(const AnySurface& ground, state::Equations equations,
                                                       Integrator integrator,
                                                       const physics::StepRules& rules);

}  // namespace woodlouse::document
