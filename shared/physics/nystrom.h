// Nystrom-4 over a sub-step h, for accelerations that depend on position and velocity (order 4, three surface
// calls; a2 and a3 share one):
//     x2 = x + h/2 v + h^2/8 a1      x4 = x + h v + h^2/2 a3
//     x += h v + h^2/6 (a1 + a2 + a3)        v += h/6 (a1 + 2 a2 + 2 a3 + a4)
// with a2 = a(x2, v + h/2 a1), a3 = a(x2, v + h/2 a2), a4 = a(x4, v + h a3).
// Source: E. J. Nystrom, 1925; Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.14.
#pragma once

#include "shared/core/vec2.h"
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

/// The step at one go; lanes/kernel.h makes it in stages. sample(Pair<T>) gives the surface,
/// accelerate(sample, velocity) the acceleration; a1 is that of the start.
template <typename T, typename Sample, typename Accelerate>
[[gnu::always_inline]] inline BasicMotion<T> nystrom4(const BasicMotion<T>& start, core::Pair<T> a1, T h,
                                                      const Sample& sample, const Accelerate& accelerate) {
  using core::Pair;
  const Pair<T> v = start.velocity;
  const T half = T(0.5) * h;
  const auto s2 = sample(nystrom_middle(start, a1, h));
  const Pair<T> a2 = accelerate(s2, v + half * a1);
  const Pair<T> a3 = accelerate(s2, v + half * a2);
  const auto s4 = sample(nystrom_last(start, a3, h));
  const Pair<T> a4 = accelerate(s4, v + h * a3);
  return nystrom_end(start, a1, a2, a3, a4, h);
}

}  // namespace woodlouse::physics
