// The integrators that a map can ask for, one struct each; `Precise` is in precise.h. A step leads from a
// start (position, velocity, a1 = its acceleration, its surface sample) over h. `field` is the motion's right
// side:
//     field.sample(x)             the surface
//     field.accelerate(s, v)      the acceleration there
//     field.kick(s, v, k)         v after the implicit half kick v' = v + k a(s, v')
// A step says how much of h it used: all, or up to where it chose to stop.
//
// kSubSteps: whether the sub-step rules and the friction stop apply (stepper.h); the document's Euler methods
// (document/euler.h) run bare. kKeepsEnergy: whether the ends of its steps are projected where nothing but
// gravity acts (energy_projection.h); the others show what they do by themselves. Orders are for smooth
// surfaces; a C2 spline caps them at about 2 where a step crosses a knot line, which `Precise` cures.
#pragma once

#include "shared/physics/nystrom.h"

namespace woodlouse::physics {

struct StepResult {
  Motion end;
  double used = 0.0;  ///< [s], 0 < used <= h
};

/// Explicit half kick, drift, implicit half kick; one surface call a step. Order 2, time-reversible without
/// dissipation, so that the energy error stays bounded.
struct VerletQ {
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = false;
  template <typename Start, typename Field>
  StepResult step(const Start& start, const Field& field, double h) const {
    const double k = 0.5 * h;
    const core::Vec2 half = start.at.velocity + k * start.acceleration;
    const core::Vec2 x = start.at.position + h * half;
    return {{x, field.kick(field.sample(x), half, k)}, h};
  }
};

/// The default; see nystrom.h. Order 4, three surface calls a step with a1's.
struct Nystrom4 {
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = true;
  template <typename Start, typename Field>
  [[gnu::always_inline]] inline StepResult step(const Start& start, const Field& field, double h) const {
    return {nystrom4(
                start.at, start.acceleration, h, [&](core::Vec2 x) { return field.sample(x); },
                [&](const auto& s, core::Vec2 v) { return field.accelerate(s, v); }),
            h};
  }
};

}  // namespace woodlouse::physics
