// Nystrom-4 over a sub-step h, for accelerations that depend on position and velocity (order 4, three surface
// calls; a2 and a3 share one):
//     x2 = x + h/2 v + h^2/8 a1      x4 = x + h v + h^2/2 a3
//     x += h v + h^2/6 (a1 + a2 + a3)        v += h/6 (a1 + 2 a2 + 2 a3 + a4)
// with a2 = a(x2, v + h/2 a1), a3 = a(x2, v + h/2 a2), a4 = a(x4, v + h a3). The way in space is h times the
// speed in the middle, |v + h/2 a2|3 at x2 (order 2).
// Source: E. J. Nystrom, 1925; Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.14.
#pragma once

#include <cmath>

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

/// What a step leads to.
struct StepResult {
  Motion end;
  double used = 0.0;   ///< [s], 0 < used <= h: all of the step, or up to where the integrator chose to stop
  double way = 0.0;    ///< in space [m]
  core::Vec2 heading;  ///< where it turns along (heading.h)
  double gain =
      0.0;  ///< of energy beyond what the push gave, in kinetic energies; only of methods that tell it
};

/// The step at one go; lanes/kernel.h makes it in stages. sample(x) gives the surface, accelerate(sample,
/// velocity) the acceleration; a1 is that of the start.
template <typename Sample, typename Accelerate>
[[gnu::always_inline]] inline StepResult nystrom4(const Motion& start, core::Vec2 a1, double h,
                                                  const Sample& sample, const Accelerate& accelerate) {
  const core::Vec2 v = start.velocity;
  const double half = 0.5 * h;
  const auto s2 = sample(nystrom_middle(start, a1, h));
  const core::Vec2 a2 = accelerate(s2, v + half * a1);
  const core::Vec2 middle = v + half * a2;
  const core::Vec2 a3 = accelerate(s2, middle);
  const auto s4 = sample(nystrom_last(start, a3, h));
  const core::Vec2 a4 = accelerate(s4, v + h * a3);
  return {nystrom_end(start, a1, a2, a3, a4, h), h, h * std::sqrt(squared_length_in_space(s2, middle)), {}};
}

/// The same where the heading turns along: accelerate(sample, velocity, heading).
template <typename Sample, typename Accelerate>
StepResult nystrom4_turning(const Motion& start, core::Vec2 heading, core::Vec2 a1, double h,
                            const Sample& sample, const Accelerate& accelerate) {
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
  const auto s4 = sample(nystrom_last(start, a3, h));
  const core::Vec2 v4 = v + h * a3;
  const core::Vec2 h4 = heading + h * r3;
  const core::Vec2 a4 = accelerate(s4, v4, h4);
  const core::Vec2 r4 = heading_rate(h4, v4);
  return {nystrom_end(start, a1, a2, a3, a4, h), h, h * std::sqrt(squared_length_in_space(s2, v3)),
          heading_end(heading, r1, r2, r3, r4, h)};
}

}  // namespace woodlouse::physics
