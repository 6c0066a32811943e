// The integrators that only the lab runs, to compare with: physics/integrators.h says what an integrator is
// and what it is given. Orders are for smooth surfaces.
#pragma once

#include <array>

#include "shared/physics/integrators.h"

namespace woodlouse::lab {

/// A symmetric method of order 2 composed to order 4 (M. Suzuki, Phys. Lett. A 146, 1990): five sub-steps of
/// p, p, 1 - 4p, p, p, p = 1 / (4 - 4^(1/3)).
inline constexpr double kOuterPart = 0.41449077179437573714;
inline constexpr double kInnerPart = -0.65796308717750294856;
inline constexpr std::array kPartsOfOrder4 = {kOuterPart, kOuterPart, kInnerPart, kOuterPart, kOuterPart};

/// VerletQ composed to order 4.
struct VerletQ4 {
  static constexpr int kSamples = 10;
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = false;
  template <typename Start, typename Field>
  physics::StepResult step(const Start& start, const Field& field, double h) const {
    physics::Motion at = start.at;
    core::Vec2 a = start.acceleration;
    for (const double part : kPartsOfOrder4) {
      const double k = 0.5 * part * h;
      const core::Vec2 half = at.velocity + k * a;
      at.position += (part * h) * half;
      const auto s = field.sample(at.position);
      at.velocity = field.kick(s, half, k);
      a = field.accelerate(s, at.velocity);
    }
    return physics::plain_result(start, field, at, h);
  }
};

/// The classical Runge-Kutta method (W. Kutta, 1901) on (x, v). Order 4, four surface calls a step with a1's.
struct RungeKutta4 {
  static constexpr int kSamples = 3;
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = false;
  template <typename Start, typename Field>
  physics::StepResult step(const Start& start, const Field& field, double h) const {
    const core::Vec2 x = start.at.position;
    const core::Vec2 v1 = start.at.velocity;
    const core::Vec2 a1 = start.acceleration;
    const double half = 0.5 * h;
    const core::Vec2 v2 = v1 + half * a1;
    const core::Vec2 a2 = field.accelerate(field.sample(x + half * v1), v2);
    const core::Vec2 v3 = v1 + half * a2;
    const core::Vec2 a3 = field.accelerate(field.sample(x + half * v2), v3);
    const core::Vec2 v4 = v1 + h * a3;
    const core::Vec2 a4 = field.accelerate(field.sample(x + h * v3), v4);
    const double sixth = h * (1.0 / 6.0);
    return physics::plain_result(
        start, field, {x + sixth * (v1 + 2.0 * (v2 + v3) + v4), v1 + sixth * (a1 + 2.0 * (a2 + a3) + a4)}, h);
  }
};

/// Dormand and Prince's fifth-order formula at a fixed step (J. Comput. Appl. Math. 6, 1980), six surface
/// calls.
struct DormandPrince5 {
  static constexpr int kSamples = 5;
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = false;
  template <typename Start, typename Field>
  physics::StepResult step(const Start& start, const Field& field, double h) const {
    const core::Vec2 x = start.at.position;
    const core::Vec2 v = start.at.velocity;
    const core::Vec2 a1 = start.acceleration;
    const auto at = [&](core::Vec2 dx, core::Vec2 w) {
      return field.accelerate(field.sample(x + h * dx), w);
    };
    const core::Vec2 v2 = v + (h / 5.0) * a1;
    const core::Vec2 a2 = at(0.2 * v, v2);
    const core::Vec2 v3 = v + h * ((3.0 / 40.0) * a1 + (9.0 / 40.0) * a2);
    const core::Vec2 a3 = at((3.0 / 40.0) * v + (9.0 / 40.0) * v2, v3);
    const core::Vec2 v4 = v + h * ((44.0 / 45.0) * a1 - (56.0 / 15.0) * a2 + (32.0 / 9.0) * a3);
    const core::Vec2 a4 = at((44.0 / 45.0) * v - (56.0 / 15.0) * v2 + (32.0 / 9.0) * v3, v4);
    const core::Vec2 v5 = v + h * ((19372.0 / 6561.0) * a1 - (25360.0 / 2187.0) * a2 +
                                   (64448.0 / 6561.0) * a3 - (212.0 / 729.0) * a4);
    const core::Vec2 a5 =
        at((19372.0 / 6561.0) * v - (25360.0 / 2187.0) * v2 + (64448.0 / 6561.0) * v3 - (212.0 / 729.0) * v4,
           v5);
    const core::Vec2 v6 = v + h * ((9017.0 / 3168.0) * a1 - (355.0 / 33.0) * a2 + (46732.0 / 5247.0) * a3 +
                                   (49.0 / 176.0) * a4 - (5103.0 / 18656.0) * a5);
    const core::Vec2 a6 = at((9017.0 / 3168.0) * v - (355.0 / 33.0) * v2 + (46732.0 / 5247.0) * v3 +
                                 (49.0 / 176.0) * v4 - (5103.0 / 18656.0) * v5,
                             v6);
    const auto sum = [&](core::Vec2 k1, core::Vec2 k3, core::Vec2 k4, core::Vec2 k5, core::Vec2 k6) {
      return h * ((35.0 / 384.0) * k1 + (500.0 / 1113.0) * k3 + (125.0 / 192.0) * k4 -
                  (2187.0 / 6784.0) * k5 + (11.0 / 84.0) * k6);
    };
    return physics::plain_result(start, field, {x + sum(v, v3, v4, v5, v6), v + sum(a1, a3, a4, a5, a6)}, h);
  }
};

}  // namespace woodlouse::lab
