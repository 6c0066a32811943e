// Energy kept by projection, where nothing but gravity acts: the end of a step is moved, by the little that
// the integrator erred, to the energy that it started with.
//
//     E(x, v) = |v|3^2 / 2 + g z,   A = dE/dv = v + vz G,   B = dE/dx = g G + vz H v,   both per unit mass
//     along G:   v -= lambda (A.G) G,   x -= lambda h^2 (B.G) G,   lambda = (E - E0) / ((A.G)^2 + h^2
//     (B.G)^2) nearest:   v -= lambda A,         x -= lambda h^2 B,         lambda = (E - E0) / (A.A + h^2
//     B.B)
// One step of Newton's method; h weighs a metre against a metre per second. The force acts along G, and so
// does the correction where that way is about as short as the nearest: what a symmetric terrain conserves
// besides (the velocity along a gutter, the angular momentum in a bowl) is left alone.
//
// It acts only where the energy errs by more than a small share a second: there it keeps errors from adding
// up over thousands of waves, while on smooth ground the integrator's own small error is better than any
// correction. Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, IV.4.
//
// + - * / only, in the order written. T: double, or several at once (core/lanes.h).
#pragma once

#include "shared/core/lanes.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// Whether nothing on the map takes energy: there, who has no thrust keeps his.
inline bool conserves_energy(const state::Parameters& p) { return !(p.drag > 0.0) && !(p.friction > 0.0); }

/// |v|3^2 / 2 + g z [m^2/s^2].
template <typename T>
[[gnu::always_inline]] inline T energy(const BasicSlopeSample<T>& s, Pair<T> v, double gravity) {
  return T(0.5) * squared_length_in_space(s, v) + T(gravity) * s.z;
}

template <typename T>
struct EnergyKept {
  BasicMotion<T> end;
  decltype(T{} < T{}) near;  ///< whether such a state was near; where not, `end` is as it was
};

/// `end`, moved to the energy `energy0` that it had at the start, but for a potential that has risen by
/// `climbed` since and pulls with `pull` at the end (central gravity: 0 of both elsewhere); s: the surface at
/// end; h: the step's length.
template <bool kCentral = false, typename Sample, typename T>
[[gnu::always_inline]] inline EnergyKept<T> with_energy(T energy0, const Sample& s, const BasicMotion<T>& end,
                                                        T h, double gravity,
                                                        [[maybe_unused]] T climbed = T(0.0),
                                                        [[maybe_unused]] Pair<T> pull = {}) {
  using core::select;
  using Truth = decltype(T{} < T{});
  const Pair<T> v = end.velocity;
  const Pair<T> gradient{s.zx, s.zy};
  const T gradient2 = dot(gradient, gradient);
  const T vz = dot(gradient, v);
  const Pair<T> by_velocity{v.x + vz * s.zx, v.y + vz * s.zy};  // A
  const Pair<T> turned = curvature_times(s, v);
  Pair<T> by_place{h * (T(gravity) * s.zx + vz * turned.x), h * (T(gravity) * s.zy + vz * turned.y)};  // h B
  if constexpr (kCentral) by_place = by_place - h * pull;
  const T speed2 = dot(v, v) + vz * vz;
  T excess = T(0.5) * speed2 + T(gravity) * s.z - energy0;
  if constexpr (kCentral) excess = excess + climbed;
  const T excess2 = excess * excess;
  constexpr double kDrift = 5e-7;  // of v^2, a second
  const T borne = T(kDrift) * h * speed2;
  const Truth errs = excess2 > borne * borne;
  const Truth is_kept = excess2 <= borne * borne;  // not the reverse for NaN

  const T nearest = dot(by_velocity, by_velocity) + dot(by_place, by_place);
  const T v_share = dot(by_velocity, gradient);
  const T x_share = dot(by_place, gradient);
  const T slope_along = v_share * v_share + x_share * x_share;
  const Truth along = slope_along > T(0.5) * gradient2 * nearest;  // at most sqrt(2) times as long
  const T slope = select(along, slope_along, nearest);
  T force2 = T(gravity * gravity) * gradient2;
  if constexpr (kCentral) force2 = force2 + dot(pull, pull);
  const T scale2 = dot(v, v) + h * h * force2;  // what v is, and what gravity makes of it in h
  constexpr double kFar = 1e-3;
  const Truth near = excess2 < T(kFar * kFar) * nearest * scale2;
  const Truth moves = near & errs;
  const T lambda = select(moves, excess / select(moves, slope, T(1.0)), T(0.0));
  const Pair<T> dv{select(along, v_share * gradient.x, by_velocity.x),
                   select(along, v_share * gradient.y, by_velocity.y)};
  const Pair<T> dx{select(along, x_share * gradient.x, by_place.x),
                   select(along, x_share * gradient.y, by_place.y)};
  return {{end.position - (lambda * h) * dx, v - lambda * dv}, static_cast<Truth>(near | is_kept)};
}

}  // namespace woodlouse::physics
