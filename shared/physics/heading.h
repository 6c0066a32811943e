// The heading where a thrust drives along it: a state of its own, that turns into the velocity's direction on
// the way,
//     h' = (v - (h.v) h) / L                   L = 0.3 m of way over the map
// The document drives along v, which says nothing at v = 0 and all but nothing beside it: from rest the
// direction then hangs on the first step's rounding. So drives act along h (surface_motion.h), which at rest
// is where the louse looks. With a constant v the angle between both decays as tan(angle / 2) = tan(angle0 /
// 2) e^(-|v| t / L); h = -v / |v|, rolling backwards, is a balance that does not last. No division: regular
// at rest.
//
// It goes through Nystrom-4 as what it is, one more velocity: h' has the shape of an acceleration that
// depends on velocities (nystrom.h), so that the order stays 4. A sub-step's way is at most kMaxHeadingWay.
//
// + - * / and sqrt only, in the order written. T: double, or several at once (core/lanes.h).
#pragma once

#include "shared/core/lanes.h"
#include "shared/core/vec2.h"

namespace woodlouse::physics {

inline constexpr double kHeadingLength = 0.3;                   ///< L [m]
inline constexpr double kMaxHeadingWay = 0.5 * kHeadingLength;  ///< of a sub-step over the map [m]

/// h' [1/s].
template <typename T>
[[gnu::always_inline]] inline core::Pair<T> heading_rate(core::Pair<T> h, core::Pair<T> v) {
  const T along = dot(h, v);
  const T inverse = T(1.0 / kHeadingLength);
  return {(v.x - along * h.x) * inverse, (v.y - along * h.y) * inverse};
}

/// The direction of u; REQUIRES u.u > 0.
template <typename T>
[[gnu::always_inline]] inline core::Pair<T> unit(core::Pair<T> u) {
  const T inverse = T(1.0) / core::square_root(dot(u, u));
  return {inverse * u.x, inverse * u.y};
}

/// Whether the heading may turn too far in a sub-step of h [s].
template <typename T>
[[gnu::always_inline]] inline auto heading_turns_too_far(core::Pair<T> v, core::Pair<T> a, T h) {
  const T h2 = h * h;
  return h2 * (dot(v, v) + h2 * dot(a, a)) > T(kMaxHeadingWay * kMaxHeadingWay);
}

/// The heading at a step's end by its rates at the four stages.
template <typename T>
[[gnu::always_inline]] inline core::Pair<T> heading_end(core::Pair<T> heading, core::Pair<T> r1,
                                                        core::Pair<T> r2, core::Pair<T> r3, core::Pair<T> r4,
                                                        T h) {
  return unit(heading + (h * T(1.0 / 6.0)) * (r1 + T(2.0) * (r2 + r3) + r4));
}

/// The heading after `time` of way at v, by one implicit step: on the way from h to v's direction, however
/// long the step. For steps whose stages resolve nothing.
inline core::Vec2 lagging_heading(core::Vec2 h, core::Vec2 v, double time) {
  const core::Vec2 u = h + (time * (1.0 / kHeadingLength)) * v;
  return dot(u, u) > 0x1p-40 ? unit(u) : h;
}

}  // namespace woodlouse::physics
