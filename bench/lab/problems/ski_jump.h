// A jump whose every moment is known: what flight is measured against.
//     z = 0                              x < 0          the table
//     z = -b x^3                         0 < x < edge   it rounds off
//     z = -b x^3 + 8 b (x - edge)^3      edge < x       the out-run
// A C2 cubic with knots at 0 and `edge`, so a not-a-knot spline through its heights is this very ground.
// Nothing but gravity acts; y is a straight line in time. Without friction a louse of speed v over the table
// leaves the ground at x1, where g + z'' vx^2 = 0:
//     6 b v^2 x1 + 3 g b^2 x1^4 = g
// There the flight's parabola touches z = -b x^3 in second order, so its height over it is b (x - x1)^3, and
// it lands where that is 8 b (x - edge)^3: at x2 = 2 edge - x1. Times on the ground are quadratures of sqrt(1
// + z'^2) / speed.
#pragma once

#include <cmath>
#include <cstddef>

#include "shared/core/vec2.h"
#include "shared/terrain/bicubic_spline.h"

namespace woodlouse::lab {

struct SkiJump {
  static constexpr double kGravity = 9.81;
  static constexpr double kBend = 0.02;  ///< b [1/m^2]
  static constexpr double kEdge = 4.0;   ///< [m]

  struct Place {
    double z, slope;
  };
  static Place ground(double x) {
    const double rounded = x > 0.0 ? x : 0.0;
    const double beyond = x > kEdge ? x - kEdge : 0.0;
    return {-kBend * rounded * rounded * rounded + 8.0 * kBend * beyond * beyond * beyond,
            -3.0 * kBend * rounded * rounded + 24.0 * kBend * beyond * beyond};
  }

  static terrain::BicubicSpline spline() {
    terrain::HeightGrid grid;
    grid.columns = 29;
    grid.rows = 17;
    grid.x_origin = grid.y_origin = -4.0;
    grid.dx = grid.dy = 0.5;
    for (std::size_t j = 0; j < grid.rows; ++j) {
      for (std::size_t i = 0; i < grid.columns; ++i) {
        grid.heights.push_back(ground(grid.x_origin + grid.dx * static_cast<double>(i)).z);
      }
    }
    return terrain::BicubicSpline(grid);
  }
};

/// The jump of a louse that starts at `start` on the table and takes off at x1; across: its velocity in y.
class Jump {
 public:
  /// REQUIRES start.x < 0 and 0 < x1 < edge.
  Jump(core::Vec2 start, double x1, double across) : start_(start), across_(across) {
    const double g = SkiJump::kGravity, b = SkiJump::kBend;
    speed_ = std::sqrt(g * (1.0 - 3.0 * b * b * x1 * x1 * x1 * x1) / (6.0 * b * x1));
    const auto [z, slope] = SkiJump::ground(x1);
    along_ = std::sqrt((speed_ * speed_ - 2.0 * g * z) / (1.0 + slope * slope));
    take_off_ = -start.x / speed_ + time_between(0.0, x1, 0.5 * speed_ * speed_);
    x2_ = 2.0 * SkiJump::kEdge - x1;
    landing_ = take_off_ + (x2_ - x1) / along_;
    const auto out = SkiJump::ground(x2_);
    const double falling = slope * along_ - g * (landing_ - take_off_);
    const double after = (along_ + out.slope * falling) / (1.0 + out.slope * out.slope);
    energy_after_ = 0.5 * after * after * (1.0 + out.slope * out.slope) + g * out.z;
  }

  [[nodiscard]] core::Vec2 start() const { return start_; }
  [[nodiscard]] core::Vec2 velocity() const { return {speed_, across_}; }
  [[nodiscard]] double take_off() const { return take_off_; }  ///< [s]
  [[nodiscard]] double landing() const { return landing_; }    ///< [s]
  [[nodiscard]] core::Vec2 landing_place() const { return {x2_, start_.y + across_ * landing_}; }
  /// Where it glides on the out-run; REQUIRES t after the landing and before it turns back.
  [[nodiscard]] core::Vec2 place_after(double t) const {
    double low = x2_, high = x2_;
    while (energy_after_ > SkiJump::kGravity * SkiJump::ground(high + 0.05).z) high += 0.05;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (time_between(x2_, middle, energy_after_) < t - landing_ ? low : high) = middle;
    }
    return {high, start_.y + across_ * t};
  }

 private:
  /// Of a glide from a to b over smooth ground with that energy in x and z: Gauss and Legendre's rule of
  /// three points.
  static double time_between(double a, double b, double energy) {
    constexpr int kPieces = 200;
    const double h = (b - a) / kPieces;
    const double aside = 0.5 * h * std::sqrt(0.6);
    const auto slowness = [&](double x) {
      const auto [z, slope] = SkiJump::ground(x);
      return std::sqrt((1.0 + slope * slope) / (2.0 * (energy - SkiJump::kGravity * z)));
    };
    double sum = 0.0;
    for (int i = 0; i < kPieces; ++i) {
      const double middle = a + (i + 0.5) * h;
      sum += 5.0 * (slowness(middle - aside) + slowness(middle + aside)) + 8.0 * slowness(middle);
    }
    return sum * h / 18.0;
  }

  core::Vec2 start_;
  double across_;
  double speed_ = 0.0, along_ = 0.0;  ///< vx on the table and in the air
  double take_off_ = 0.0, landing_ = 0.0;
  double x2_ = 0.0;
  double energy_after_ = 0.0;  ///< without that of `across`
};

}  // namespace woodlouse::lab
