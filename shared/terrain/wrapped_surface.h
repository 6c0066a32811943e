// A surface repeated without end along one axis or both: a map whose edges wrap.
//
//     z(x, y) = inner(x - k P, y - l Q),   k, l whole turns, P, Q the sides of the inner surface's domain
// Inside the inner domain the point is handed on untouched: the same bits as the inner surface. domain() has
// no end along an axis that wraps, so nothing stands in the way there; period() is the inner domain.
// Continuity: over the seam that of the inner surface's periodic ends (BicubicSpline with
// SplineEnds::kPeriodic: C2).
// Outside, along an axis that doesn't wrap: the inner surface's way.
// A coordinate beyond 2^52 periods, infinite or NaN has no place left to wrap to: the sample is NaN.
// Cost: two comparisons an axis inside the period, a multiplication and a conversion more outside.
// Chapter: none; the document's maps end.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

enum class WrappedAxes { kX, kY, kBoth };

/// `x` brought into [low, high] by whole periods high - low; NaN where that has no meaning.
inline double wrapped(double x, double low, double high) {
  if (x >= low && x <= high) return x;
  const double period = high - low;
  const double turns = (x - low) / period;
  constexpr double kLimit = 4503599627370496.0;
  if (!(turns > -kLimit && turns < kLimit)) return std::numeric_limits<double>::quiet_NaN();
  double whole = static_cast<double>(static_cast<long long>(turns));
  if (whole > turns) whole -= 1.0;
  const double inside = x - whole * period;
  return inside < low ? low : (inside > high ? high : inside);
}

template <Surface S>
class WrappedSurface {
 public:
  static constexpr bool has_hessian = kHasHessian<S>;

  explicit WrappedSurface(S inner, WrappedAxes axes = WrappedAxes::kBoth)
      : inner_(std::move(inner)),
        period_(inner_.domain()),
        wraps_x_(axes != WrappedAxes::kY),
        wraps_y_(axes != WrappedAxes::kX) {}

  [[nodiscard]] SurfaceSample sample(double x, double y) const {
    if (wraps_x_) x = wrapped(x, period_.x_min, period_.x_max);
    if (wraps_y_) y = wrapped(y, period_.y_min, period_.y_max);
    if (std::isnan(x) || std::isnan(y)) {
      constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
      return {kNowhere, kNowhere, kNowhere, kNowhere, kNowhere, kNowhere};
    }
    return inner_.sample(x, y);
  }
  [[nodiscard]] Rectangle domain() const {
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    return {wraps_x_ ? -kEndless : period_.x_min, wraps_y_ ? -kEndless : period_.y_min,
            wraps_x_ ? kEndless : period_.x_max, wraps_y_ ? kEndless : period_.y_max};
  }
  [[nodiscard]] Rectangle period() const { return period_; }
  [[nodiscard]] double cell() const { return inner_.cell(); }
  [[nodiscard]] const S& inner() const { return inner_; }

 private:
  S inner_;
  Rectangle period_;
  bool wraps_x_;
  bool wraps_y_;
};

}  // namespace woodlouse::terrain
