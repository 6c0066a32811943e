// A planet on flat ground under the pull k / r^2 (chapter 2.3), in closed form: what central gravity is
// measured against.
//
// From (radius, 0) with (0, speed), with e = radius speed^2 / k - 1 and a = radius / (1 - e): an ellipse
// about the origin. For speed^2 < k / radius the start is its far end and -e its eccentricity; the same
// formulas hold:
//     M = E - e sin E (Kepler's equation),  x = a (cos E - e),  y = a sqrt(1 - e^2) sin E
// since a start at the near end has E = 0, and for e < 0 the far end takes its place.
#pragma once

#include <cmath>
#include <numbers>

#include "shared/core/vec2.h"

namespace woodlouse::lab {

class KeplerEllipse {
 public:
  /// k: the pull [m^3/s^2]. REQUIRES 0 < radius speed^2 < 2 k.
  KeplerEllipse(double k, double radius, double speed)
      : k_(k),
        start_{radius, 0.0},
        speed_(speed),
        e_(radius * speed * speed / k - 1.0),
        axis_(radius / (1.0 - e_)) {}

  [[nodiscard]] core::Vec2 start() const { return start_; }
  [[nodiscard]] core::Vec2 velocity() const { return {0.0, speed_}; }
  [[nodiscard]] double eccentricity() const { return std::fabs(e_); }
  [[nodiscard]] double period() const {
    return 2.0 * std::numbers::pi * std::sqrt(axis_ * axis_ * axis_ / k_);
  }  ///< [s]

  [[nodiscard]] core::Vec2 position_at(double t) const {
    const double mean = std::remainder(2.0 * std::numbers::pi * t / period(), 2.0 * std::numbers::pi);
    double low = mean - std::fabs(e_);  // M and E are never further apart than that
    double high = mean + std::fabs(e_);
    double anomaly = mean;
    for (int i = 0; i < 100; ++i) {
      const double beyond = anomaly - e_ * std::sin(anomaly) - mean;
      (beyond > 0.0 ? high : low) = anomaly;
      double next = anomaly - beyond / (1.0 - e_ * std::cos(anomaly));
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (next == anomaly) break;
      anomaly = next;
    }
    return {axis_ * (std::cos(anomaly) - e_), axis_ * std::sqrt(1.0 - e_ * e_) * std::sin(anomaly)};
  }

  /// Kinetic energy and that of the pull, per mass; negative on an ellipse.
  [[nodiscard]] double energy(core::Vec2 x, core::Vec2 v) const {
    return 0.5 * dot(v, v) - k_ / std::hypot(x.x, x.y);
  }
  [[nodiscard]] double energy() const { return energy(start(), velocity()); }
  [[nodiscard]] static double angular_momentum(core::Vec2 x, core::Vec2 v) { return x.x * v.y - x.y * v.x; }

 private:
  double k_;
  core::Vec2 start_;
  double speed_;
  double e_;     ///< signed: negative where the start is the far end
  double axis_;  ///< half the long axis [m]
};

}  // namespace woodlouse::lab
