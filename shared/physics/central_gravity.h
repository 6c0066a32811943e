// The pull towards the map's origin, k / r^2 (chapter 2.3), and the core within which it is smooth.
//
// A point's pull has no bound, and no step resolves what passes it near enough: a brake then makes energy. So
// within the core's radius R the pull is that of a cloud of mass; with q = r^2 / R^2:
//     F = -(k / R^3) (35/8 - 21/4 q + 15/8 q^2) x
//     potential = -k / R + (k / 2R) (35/8 q - 21/8 q^2 + 5/8 q^3 - 19/8)
// At q = 1 both, and two more derivatives by q, are those of -k x / r^3 and -k / r: a step across the rim
// errs no more than one beside it. A core whose pull just grows in proportion to r has a kink there, which
// cost 100 times as much energy.
//
// + - * / and sqrt only, in the order written: these are the simulation's bits.
#pragma once

#include <cassert>

#include "shared/core/lanes.h"
#include "shared/core/vec2.h"
#include "shared/state/parameters.h"

namespace woodlouse::physics {

/// The pull per distance in the middle of a core of radius 1 at k = 1.
inline constexpr double kCorePull = 35.0 / 8.0;

/// -F / r at a point [1/s^2]; REQUIRES core_radius > 0.
inline double central_pull(core::Vec2 x, const state::Parameters& p) {
  const double r2 = dot(x, x);
  const double core2 = p.core_radius * p.core_radius;
  if (r2 >= core2) return p.central_gravity / (r2 * core::square_root(r2));
  const double q = r2 / core2;
  return p.central_gravity / (core2 * p.core_radius) * (kCorePull - (21.0 / 4.0 - 15.0 / 8.0 * q) * q);
}

/// Its potential per unit mass [m^2/s^2], 0 at infinity; REQUIRES core_radius > 0.
inline double central_potential(core::Vec2 x, const state::Parameters& p) {
  const double r2 = dot(x, x);
  const double core2 = p.core_radius * p.core_radius;
  if (r2 >= core2) return -p.central_gravity / core::square_root(r2);
  const double q = r2 / core2;
  const double part = ((5.0 / 8.0 * q - 21.0 / 8.0) * q + kCorePull) * q - 19.0 / 8.0;
  return -p.central_gravity / p.core_radius + 0.5 * p.central_gravity / p.core_radius * part;
}

/// The smallest core that sub-steps resolve at a rate of ticks, [1/s] and up.
double resolved_core_radius(double central_gravity, double tick_hz);
/// The lowest rate of ticks at which sub-steps resolve that core [1/s].
double resolving_rate(double central_gravity, double core_radius);

/// The core of a map that names none: one that is resolved from 15 ticks a second on. The same whatever the
/// rate.
double default_core_radius(double central_gravity);

}  // namespace woodlouse::physics
