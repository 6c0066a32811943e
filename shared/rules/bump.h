// What becomes of two lice that run into each other.
//
// Each moves in its tangent plane, where kinetic energy is v'G v / 2 with G = I + g g', g the ground's
// gradient there. An impulse J along n, the way over the map from one to the other, changes the velocities by
// -J G1^-1 n and J G2^-1 n. With u = n.(v2 - v1) < 0 before, J = -(1 + e) u / (n.G1^-1 n + n.G2^-1 n) makes
// it -e u and takes (1 - e^2) u^2 / 2 over the same from the energy: never gives. Places stay, so nobody is
// lifted.
#pragma once

#include <cassert>
#include <cmath>
#include <optional>

#include "shared/core/vec2.h"

namespace woodlouse::rules {

struct Body {
  core::Vec2 velocity;  ///< over the map [m/s]
  core::Vec2 gradient;  ///< of the ground where it is [1]
};

struct Bump {
  core::Vec2 first, second;  ///< the velocities after it [m/s]
  double impulse = 0.0;      ///< per unit mass, J |n| [m/s]
};

/// From the first to the second. Less than 1e-12 m apart they have no direction: then as if one stood east of
/// the other.
inline core::Vec2 direction(core::Vec2 between) {
  constexpr double kTogether2 = 1e-24;  // [m^2]
  return core::dot(between, between) < kTogether2 ? core::Vec2{1.0, 0.0} : between;
}

/// Whether the second comes nearer to the first, as `between` leads from the first to the second [m].
inline bool is_approach(core::Vec2 between, core::Vec2 first, core::Vec2 second) {
  return core::dot(direction(between), second - first) < 0.0;
}

/// How fast, over the map [m/s]; below 0 where they part.
inline double closing_speed(core::Vec2 between, core::Vec2 first, core::Vec2 second) {
  const core::Vec2 n = direction(between);
  return core::dot(n, first - second) / std::sqrt(core::dot(n, n));
}

/// G^-1 n
inline core::Vec2 yields(core::Vec2 gradient, core::Vec2 n) {
  const double part = core::dot(gradient, n) / (1.0 + core::dot(gradient, gradient));
  return n - part * gradient;
}

/// Nothing: they do not come nearer. restitution: 0..1.
inline std::optional<Bump> bump(core::Vec2 between, const Body& first, const Body& second,
                                double restitution) {
  assert(restitution >= 0.0 && restitution <= 1.0);
  const core::Vec2 n = direction(between);
  const double u = core::dot(n, second.velocity - first.velocity);
  if (!(u < 0.0)) return std::nullopt;
  const core::Vec2 first_yields = yields(first.gradient, n), second_yields = yields(second.gradient, n);
  const double j = -(1.0 + restitution) * u / (core::dot(n, first_yields) + core::dot(n, second_yields));
  return Bump{first.velocity - j * first_yields, second.velocity + j * second_yields,
              j * std::sqrt(core::dot(n, n))};
}

}  // namespace woodlouse::rules
