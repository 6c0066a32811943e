// Nystrom-4 over a sub-step h, for accelerations that depend on position and velocity (order 4, three surface
// calls; a2 and a3 share one):
//     x2 = x + h/2 v + h^2/8 a1      x4 = x + h v + h^2/2 a3
//     x += h v + h^2/6 (a1 + a2 + a3)        v += h/6 (a1 + 2 a2 + 2 a3 + a4)
// with a2 = a(x2, v + h/2 a1), a3 = a(x2, v + h/2 a2), a4 = a(x4, v + h a3). The way in space is h times the
// speed in the middle, |v + h/2 a2|3 at x2 (order 2).
// Source: E. J. Nystrom, 1925; Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.14.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "shared/core/lanes.h"
#include "shared/core/vec2.h"
#include "shared/physics/heading.h"
#include "shared/physics/surface_motion.h"
#include "shared/terrain/surface.h"

namespace woodlouse::physics {

/// Where a louse is and how fast it moves over the map plane.
template <typename T>
struct BasicMotion {
  core::Pair<T> position;
  core::Pair<T> velocity;
};
using Motion = BasicMotion<double>;

/// x2, where a2 and a3 are taken.
template <typename T>
[[gnu::always_inline]] inline core::Pair<T> nystrom_middle(const BasicMotion<T>& start, core::Pair<T> a1,
                                                           T h) {
  const T half = T(0.5) * h;
  return start.position + half * start.velocity + (T(0.5) * half * half) * a1;
}

/// x4, where a4 is taken.
template <typename T>
[[gnu::always_inline]] inline core::Pair<T> nystrom_last(const BasicMotion<T>& start, core::Pair<T> a3, T h) {
  return start.position + h * start.velocity + (h * (T(0.5) * h)) * a3;
}

template <typename T>
[[gnu::always_inline]] inline BasicMotion<T> nystrom_end(const BasicMotion<T>& start, core::Pair<T> a1,
                                                         core::Pair<T> a2, core::Pair<T> a3, core::Pair<T> a4,
                                                         T h) {
  const T sixth = h * T(1.0 / 6.0);
  return {start.position + h * start.velocity + (h * sixth) * (a1 + a2 + a3),
          start.velocity + sixth * (a1 + T(2.0) * (a2 + a3) + a4)};
}

/// The cubic in time through both ends of a step over h: where it is after t, within h^4 of the motion.
inline Motion on_cubic(const Motion& start, const Motion& end, double h, double t) {
  const core::Vec2 moved = end.position - start.position;
  const core::Vec2 v0 = h * start.velocity;
  const core::Vec2 v1 = h * end.velocity;
  const core::Vec2 c = 3.0 * moved - 2.0 * v0 - v1;
  const core::Vec2 d = v0 + v1 - 2.0 * moved;
  const double s = t / h;
  return {start.position + s * (v0 + s * (c + s * d)), (1.0 / h) * (v0 + s * (2.0 * c + (3.0 * s) * d))};
}

/// The quintic in time through place, velocity and acceleration of both ends of a step over h, a part s of it
/// after the start: within h^6 of the motion.
template <typename T>
[[gnu::always_inline]] inline BasicMotion<T> on_quintic(const BasicMotion<T>& start, core::Pair<T> a0,
                                                        const BasicMotion<T>& end, core::Pair<T> a1, T h,
                                                        double s) {
  const double s2 = s * s, s3 = s2 * s, s4 = s2 * s2, s5 = s2 * s3;
  const core::Pair<T> moved = end.position - start.position;
  const core::Pair<T> v0 = start.velocity, v1 = end.velocity;
  const T h2 = h * h;
  return {start.position + T(10.0 * s3 - 15.0 * s4 + 6.0 * s5) * moved +
              h * (T(s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5) * v0 + T(7.0 * s4 - 4.0 * s3 - 3.0 * s5) * v1) +
              h2 * (T(0.5 * s2 - 1.5 * s3 + 1.5 * s4 - 0.5 * s5) * a0 + T(0.5 * s3 - s4 + 0.5 * s5) * a1),
          (T(30.0 * s2 - 60.0 * s3 + 30.0 * s4) / h) * moved +
              T(1.0 - 18.0 * s2 + 32.0 * s3 - 15.0 * s4) * v0 + T(28.0 * s3 - 12.0 * s2 - 15.0 * s4) * v1 +
              h * (T(s - 4.5 * s2 + 6.0 * s3 - 2.5 * s4) * a0 + T(1.5 * s2 - 4.0 * s3 + 2.5 * s4) * a1)};
}

/// Where along a step Lobatto's four points lie besides its ends: (5 -+ sqrt 5) / 10 of it.
inline constexpr double kEarly = 0.276393202250021;
inline constexpr double kLate = 0.723606797749979;
inline constexpr int kLobattoSamples = 3;

/// How far astray a step over h led [m], if nothing else does so within kAhead: what its end lacks of the
/// start and of the accelerations on its way, integrated by Lobatto's four points along the quintic. Of any
/// method, of order 4 or less, to a factor: the leading term where accelerations hang on the place, 0.3
/// to 1.4 of it where they hang on the velocity alone (an error in place of h^5 bends the quintic's
/// velocities by h^4), and of its size where the acceleration has a kink. accelerate(part of the step,
/// motion). Sources: W. H. Enright, A new error-control for initial value solvers, 1989 (the defect of an
/// interpolant); M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 25.4.32.
inline constexpr double kAhead = 1.0;  // [s]
template <typename T, typename Accelerate>
[[gnu::always_inline]] inline T astray(const BasicMotion<T>& start, core::Pair<T> a0,
                                       const BasicMotion<T>& end, T h, const Accelerate& accelerate) {
  // One call for all three, that what it takes of code is there once: where it is loaded over a network
  // (web/core) that counts. gcc makes three of it again: 4 % of a crowd's steps with a tolerance.
  const double part[kLobattoSamples] = {1.0, kEarly, kLate};
  core::Pair<T> a[kLobattoSamples];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 3
#endif
  for (int i = 0; i < kLobattoSamples; ++i)
    a[i] = accelerate(part[i], i == 0 ? end : on_quintic(start, a0, end, a[0], h, part[i]));
  const auto& [a1, early, late] = a;
  const T twelfth = h * T(1.0 / 12.0);
  const core::Pair<T> v = start.velocity + twelfth * (a0 + a1 + T(5.0) * (early + late)) - end.velocity;
  const core::Pair<T> x =
      h * (start.velocity + twelfth * (a0 + T(5.0 * kLate) * early + T(5.0 * kEarly) * late)) -
      (end.position - start.position);
  return T(kAhead) * core::square_root(dot(v, v)) + core::square_root(dot(x, x));
}

/// What a step has of energy beyond what it may have, per unit mass [m^2/s^2].
template <typename T>
struct BasicGain {
  T energy;   ///< gained beyond what the push gave on the way; infinite or NaN where that can't be told
  T kinetic;  ///< the kinetic energies of both ends together, what a gain is measured by
  [[nodiscard]] bool is_told() const requires std::is_same_v<T, double> { return !(kinetic < 0.0); }
};
using Gain = BasicGain<double>;

/// The gain of a step over h from a place of height z0 at |v|3^2 = speed2, moved by `moved`, with a push; of
/// what else there is it has `fallen` so far [m^2/s^2]. As the sample s tells, that was taken `beyond` before
/// the end: by its second order, which holds only near there. A push gives what it does by the mean of both
/// speeds, and the little that this errs; a speed in the middle may be anything.
template <typename Sample, typename T>
[[gnu::always_inline]] inline BasicGain<T> energy_gain(T z0, T speed2, core::Pair<T> moved, const Sample& s,
                                                       core::Pair<T> beyond, core::Pair<T> velocity, T h,
                                                       double gravity, T push, T fallen) {
  T zx = s.zx, zy = s.zy;
  T climbed;
  auto near = fallen <= fallen;
  if constexpr (terrain::Curved<Sample>) {
    const core::Pair<T> turned = curvature_times(s, beyond);
    zx = zx + turned.x;
    zy = zy + turned.y;
    climbed = s.z - z0 + T(0.5) * ((s.zx + zx) * beyond.x + (s.zy + zy) * beyond.y);
  } else {
    climbed = zx * moved.x + zy * moved.y;
  }
  const T climb = zx * velocity.x + zy * velocity.y;
  const T before = T(0.5) * speed2;
  const T after = T(0.5) * (dot(velocity, velocity) + climb * climb);
  const T kinetic = before + after;
  constexpr double kNear = 0x1p-5;  // of the way
  if constexpr (terrain::Curved<Sample>)
    near = dot(beyond, beyond) <= T(2.0 * kNear * kNear) * (h * h) * kinetic;
  const T speeds = core::square_root(speed2) + core::square_root(T(2.0) * after);
  const T given = push * h * T(0.5 * (1.0 + 0x1p-13)) * speeds;
  const T energy = after - before + T(gravity) * climbed - fallen - given;
  return {core::select(near, energy, T(std::numeric_limits<double>::infinity())), kinetic};
}

/// Whether the acceleration bends so little within a step that it gains no energy worth a look: by its second
/// difference; v4: the velocity of the last stage.
template <typename T>
[[gnu::always_inline]] inline auto nystrom_is_smooth(core::Pair<T> a1, core::Pair<T> a2, core::Pair<T> a3,
                                                     core::Pair<T> a4, core::Pair<T> v4, T h) {
  constexpr double kSmooth = 1e-3;  // of v
  const core::Pair<T> bend = (a1 - a2) + (a4 - a3);
  return (h * h) * dot(bend, bend) <= T(kSmooth * kSmooth) * dot(v4, v4);
}
/// Of a step that is smooth.
inline constexpr Gain kNoGain{0.0, 1.0};

/// What a step leads to.
struct StepResult {
  Motion end;
  double used = 0.0;     ///< [s], 0 < used <= h: all of the step, or up to where the integrator chose to stop
  double way = 0.0;      ///< in space [m]
  core::Vec2 heading;    ///< where it turns along (heading.h)
  Gain gain{0.0, -1.0};  ///< only of methods that tell it
};

/// The step at one go; lanes/kernel.h makes it in stages. sample(x) gives the surface, accelerate(sample,
/// velocity) the acceleration; a1 is that of the start. gain(sample, its place, end) tells the Gain.
template <typename Sample, typename Accelerate, typename TellGain>
[[gnu::always_inline]] inline StepResult nystrom4(const Motion& start, core::Vec2 a1, double h,
                                                  const Sample& sample, const Accelerate& accelerate,
                                                  const TellGain& gain) {
  const core::Vec2 v = start.velocity;
  const double half = 0.5 * h;
  const auto s2 = sample(nystrom_middle(start, a1, h));
  const core::Vec2 a2 = accelerate(s2, v + half * a1);
  const core::Vec2 middle = v + half * a2;
  const core::Vec2 a3 = accelerate(s2, middle);
  const core::Vec2 x4 = nystrom_last(start, a3, h);
  const auto s4 = sample(x4);
  const core::Vec2 v4 = v + h * a3;
  const core::Vec2 a4 = accelerate(s4, v4);
  const Motion end = nystrom_end(start, a1, a2, a3, a4, h);
  const double way = h * std::sqrt(squared_length_in_space(s2, middle));
  const bool smooth = nystrom_is_smooth(a1, a2, a3, a4, v4, h);
  return {end, h, way, {}, smooth ? kNoGain : gain(s4, x4, end)};
}

/// The same where the heading turns along: accelerate(sample, velocity, heading).
template <typename Sample, typename Accelerate, typename TellGain>
StepResult nystrom4_turning(const Motion& start, core::Vec2 heading, core::Vec2 a1, double h,
                            const Sample& sample, const Accelerate& accelerate, const TellGain& gain) {
  const core::Vec2 v = start.velocity;
  const double half = 0.5 * h;
  const core::Vec2 r1 = heading_rate(heading, v);
  const auto s2 = sample(nystrom_middle(start, a1, h));
  const core::Vec2 v2 = v + half * a1;
  const core::Vec2 h2 = heading + half * r1;
  const core::Vec2 a2 = accelerate(s2, v2, h2);
  const core::Vec2 r2 = heading_rate(h2, v2);
  const core::Vec2 v3 = v + half * a2;
  const core::Vec2 h3 = heading + half * r2;
  const core::Vec2 a3 = accelerate(s2, v3, h3);
  const core::Vec2 r3 = heading_rate(h3, v3);
  const core::Vec2 x4 = nystrom_last(start, a3, h);
  const auto s4 = sample(x4);
  const core::Vec2 v4 = v + h * a3;
  const core::Vec2 h4 = heading + h * r3;
  const core::Vec2 a4 = accelerate(s4, v4, h4);
  const core::Vec2 r4 = heading_rate(h4, v4);
  const Motion end = nystrom_end(start, a1, a2, a3, a4, h);
  const double way = h * std::sqrt(squared_length_in_space(s2, v3));
  const bool smooth = nystrom_is_smooth(a1, a2, a3, a4, v4, h);
  return {end, h, way, heading_end(heading, r1, r2, r3, r4, h), smooth ? kNoGain : gain(s4, x4, end)};
}

}  // namespace woodlouse::physics
