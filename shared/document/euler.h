// The document's integrators (chapter 2): one sample of the surface a step. `start` is the step's start
// (position, velocity, its acceleration); physics/integrators.h says what an integrator is.
//
// kSubSteps, kKeepsEnergy: they run bare, as printed: no sub-steps, no friction stop, no rest, no projection.
#pragma once

#include "shared/physics/integrators.h"

namespace woodlouse::document {

/// x += h v, v += h a. Order 1.
struct ExplicitEuler {
  static constexpr bool kSubSteps = false;
  static constexpr int kSamples = 0;
  static constexpr bool kKeepsEnergy = false;
  template <typename Start, typename Field>
  physics::StepResult step(const Start& start, const Field& field, double h) const {
    return physics::plain_result(
        start, field, {start.at.position + h * start.at.velocity, start.at.velocity + h * start.acceleration},
        h);
  }
};

/// v += h a, then x += h v with the new v. Order 1; not symplectic here, since a depends on v.
struct FalseEuler {
  static constexpr bool kSubSteps = false;
  static constexpr int kSamples = 0;
  static constexpr bool kKeepsEnergy = false;
  template <typename Start, typename Field>
  physics::StepResult step(const Start& start, const Field& field, double h) const {
    const core::Vec2 v = start.at.velocity + h * start.acceleration;
    return physics::plain_result(start, field, {start.at.position + h * v, v}, h);
  }
};

}  // namespace woodlouse::document
