// What a surface is: a height over the map plane with its first and second derivatives.
//
// The concept every surface meets, so that the equations of motion can be compiled for each without an
// indirect call:
//     SurfaceSample sample(double x, double y) const   z, gradient, Hessian at a map-plane point; SlopeSample
//     of a
//                                                       surface that is flat: whoever uses it leaves out
//                                                       curvature
//     Rectangle domain() const                          where the surface is defined
//     double cell() const                               side of its smallest polynomial cell [m]; infinite:
//     none
// sample() outside the domain continues the edge's polynomial (a step's stages look past a wall by a fraction
// of a step); whoever takes points from outside checks domain() first.
//
// A surface without a usable Hessian (its gradient jumps, or is not its height's derivative) says
//     static constexpr bool has_hessian = false;
// and leaves NaN (kNoHessian) in zxx, zxy, zyy, so that a use that slipped through shows. Whoever needs the
// Hessian asks for CurvedSurface instead of Surface and is refused at compile time.
#pragma once

#include <concepts>
#include <limits>

#include "shared/core/vec2.h"

namespace woodlouse::terrain {

/// Height z [m] and gradient (zx, zy) [1] at one point. T: double, or several at once (core/lanes.h).
template <typename T>
struct BasicSlopeSample {
  T z{};
  T zx{};
  T zy{};
};

/// The same with the Hessian (zxx, zxy, zyy) [1/m].
template <typename T>
struct BasicSurfaceSample : BasicSlopeSample<T> {
  T zxx{};
  T zxy{};
  T zyy{};
};

using SlopeSample = BasicSlopeSample<double>;
using SurfaceSample = BasicSurfaceSample<double>;

/// A sample of a surface that may be curved.
template <typename Sample>
concept Curved = requires(const Sample& s) {
  s.zxx;
};

/// A closed axis-parallel rectangle of the map plane [m].
struct Rectangle {
  double x_min = 0.0;
  double y_min = 0.0;
  double x_max = 0.0;
  double y_max = 0.0;

  [[nodiscard]] constexpr bool contains(double x, double y) const {
    return x >= x_min && x <= x_max && y >= y_min && y <= y_max;
  }
  friend constexpr bool operator==(const Rectangle&, const Rectangle&) = default;
};

template <typename S>
concept Surface = requires(const S& s, double x, double y) {
  { s.sample(x, y) } -> std::convertible_to<SlopeSample>;
  { s.domain() } -> std::same_as<Rectangle>;
  { s.cell() } -> std::same_as<double>;
};

/// What stands in the Hessian's places of a sample of a surface that has none.
inline constexpr double kNoHessian = std::numeric_limits<double>::quiet_NaN();

/// Whether S fills the Hessian; surfaces that don't mention it do.
template <typename S>
inline constexpr bool kHasHessian = [] {
  if constexpr (requires { S::has_hessian; }) {
    return static_cast<bool>(S::has_hessian);
  } else {
    return true;
  }
}();

/// A surface that the exact equations of motion can run on.
template <typename S>
concept CurvedSurface = Surface<S> && kHasHessian<S>;

}  // namespace woodlouse::terrain
