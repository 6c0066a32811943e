// What a point gets that lies outside a surface's domain, or where there is no ground: named, never
// a silent clamp.
//
//     kExtend   the edge's polynomial goes on. What every sample() does: steps look past a wall by a fraction
//               of a cell, and 1e-16 beyond the edge is as good as the edge. Grows like its polynomial; never
//               a clamped height. sample_anywhere() goes kExtendReach sides of the domain far and has no
//               sample beyond.
//     kNothing  no sample. For whoever takes points from outside: files, sockets, cursors.
// Wrapping is a type, not a policy: WrappedSurface has no outside along its axes.
// A coordinate that is NaN or infinite has no sample under any policy.
//
// Knots without data (NODATA), by surface:
//     BicubicSpline, WrappedSurface of it, DocumentSpline   REQUIRE finite heights: the spline is global, one
//                   NaN knot would reach every cell of its row and column. Map loaders refuse holes, or
//                   TiledBSpline is taken.
//     Biquadratic, BlendedBiquadratic, GaussGradient   a NaN knot reaches the points whose stencil holds it,
//                   no others: 1.5 cells around it (blended: 2; Gauss: gradient 2, height 1.5; at the rim
//                   half a cell or a cell more, where the stencil has moved inward).
//     TiledBSpline  NoDataPolicy: kHole or kFill (tiled_bspline.h).
#pragma once

#include <cmath>
#include <optional>

#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

enum class OutsidePolicy { kExtend, kNothing };

/// Whether there is ground to stand on: inside the domain and, for a surface that knows of holes, in none.
template <Surface S>
[[nodiscard]] bool is_ground(const S& surface, double x, double y) {
  if (!surface.domain().contains(x, y)) return false;
  if constexpr (requires { surface.has_ground(x, y); }) return surface.has_ground(x, y);
  return true;
}

inline constexpr double kExtendReach = 1000.0;  ///< [sides of the domain]

/// Whether (x, y) is at most kExtendReach sides beyond the domain; false for NaN and infinities.
inline bool is_near(const Rectangle& domain, double x, double y) {
  const double far_x = kExtendReach * (domain.x_max - domain.x_min);
  const double far_y = kExtendReach * (domain.y_max - domain.y_min);
  return std::isfinite(x) && std::isfinite(y) && x >= domain.x_min - far_x && x <= domain.x_max + far_x &&
         y >= domain.y_min - far_y && y <= domain.y_max + far_y;
}

/// The sample that the policy gives, or nothing. Never aborts, whatever the numbers.
template <Surface S>
[[nodiscard]] std::optional<SurfaceSample> sample_anywhere(const S& surface, double x, double y,
                                                           OutsidePolicy policy) {
  if (!is_near(surface.domain(), x, y)) return std::nullopt;
  if (policy == OutsidePolicy::kNothing && !is_ground(surface, x, y)) return std::nullopt;
  const SurfaceSample s = surface.sample(x, y);
  if (!std::isfinite(s.z)) return std::nullopt;
  return s;
}

}  // namespace woodlouse::terrain
