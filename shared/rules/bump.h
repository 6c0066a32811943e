// What becomes of two lice that run into each other.
//
// Each moves in its tangent plane, where kinetic energy is v'G v / 2 with G = I + g g', g the ground's
// gradient there. An impulse J along n, the way over the map from one to the other, changes the velocities by
// -J G1^-1 n and J G2^-1 n. With u = n.(v2 - v1) < 0 before, J = -(1 + e) u / (n.G1^-1 n + n.G2^-1 n) makes
// it -e u and takes (1 - e^2) u^2 / 2 over the same from the energy: never gives. Places stay, so nobody is
// lifted.
#pragma once

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

/// Whether the second comes nearer to the first, as `between` leads from the first to the second [m].
/// Less than 1e-12 m apart they have no direction: then as if one stood east of the other.
bool is_approach(core::Vec2 between, core::Vec2 first, core::Vec2 second);
/// How fast, over the map [m/s]; below 0 where they part.
double closing_speed(core::Vec2 between, core::Vec2 first, core::Vec2 second);
/// Nothing: they do not come nearer. restitution: 0..1.
std::optional<Bump> bump(core::Vec2 between, const Body& first, const Body& second, double restitution);

}  // namespace woodlouse::rules
