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
#include <type_traits>

#include "shared/core/lanes.h"
#include "shared/core/vec2.h"
#include "shared/state/parameters.h"

namespace woodlouse::physics {

/// The pull per distance in the middle of a core of radius 1 at k = 1.
inline constexpr double kCorePull = 35.0 / 8.0;

/// outside(r2) where r2 >= R^2, inside(q) in the core: lanes have both and choose, a double has the one.
template <typename T, typename Outside, typename Inside>
[[gnu::always_inline]] inline T outside_or_in_core(core::Pair<T> x, const state::Parameters& p,
                                                   const Outside& outside, const Inside& inside) {
  const T r2 = dot(x, x);
  const T core2 = T(p.core_radius * p.core_radius);
  if constexpr (std::is_same_v<T, double>) {
    return r2 >= core2 ? outside(r2) : inside(r2 / core2);
  } else {
    const auto is_outside = r2 >= core2;
    if (!core::any(~is_outside)) return outside(r2);
    return core::select(is_outside, outside(r2), inside(r2 / core2));
  }
}

/// -F / r at a point [1/s^2]; REQUIRES core_radius > 0. T: double, or several at once (core/lanes.h).
template <typename T>
[[gnu::always_inline]] inline T central_pull(core::Pair<T> x, const state::Parameters& p) {
  const double k = p.central_gravity;
  const double core2 = p.core_radius * p.core_radius;
  return outside_or_in_core(
      x, p, [&](T r2) __attribute__((always_inline)) { return T(k) / (r2 * core::square_root(r2)); },
      [&](T q) __attribute__((always_inline)) {
        return T(k / (core2 * p.core_radius)) * (T(kCorePull) - (T(21.0 / 4.0) - T(15.0 / 8.0) * q) * q);
      });
}

/// Its potential per unit mass [m^2/s^2], 0 at infinity; REQUIRES core_radius > 0.
template <typename T>
[[gnu::always_inline]] inline T central_potential(core::Pair<T> x, const state::Parameters& p) {
  const double k = p.central_gravity;
  return outside_or_in_core(
      x, p, [&](T r2) __attribute__((always_inline)) { return T(-k) / core::square_root(r2); },
      [&](T q) __attribute__((always_inline)) {
        const T part = ((T(5.0 / 8.0) * q - T(21.0 / 8.0)) * q + T(kCorePull)) * q - T(19.0 / 8.0);
        return T(-k / p.core_radius) + T(0.5 * k / p.core_radius) * part;
      });
}

/// The smallest core that sub-steps resolve at a rate of ticks, [1/s] and up.
double resolved_core_radius(double central_gravity, double tick_hz);
/// The lowest rate of ticks at which sub-steps resolve that core [1/s].
double resolving_rate(double central_gravity, double core_radius);

/// The core of a map that names none: one that is resolved from 15 ticks a second on. The same whatever the
/// rate.
double default_core_radius(double central_gravity);

}  // namespace woodlouse::physics
