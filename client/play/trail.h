// Where a louse has been: points of the world a fixed way apart, so that a trail does not creep and a frame
// changes only at its two ends.
#pragma once

#include <cstddef>
#include <vector>

#include "shared/core/vec2.h"

namespace woodlouse::client {

class Trail {
 public:
  static constexpr std::size_t kPoints = 120;  ///< the oldest are forgotten beyond

  /// spacing [m] > 0: a point is kept once the louse is this far from the last; map width / 200 looks well.
  explicit Trail(double spacing) : spacing_(spacing) {}

  /// Forgets everything on a jump (a respawn, a seam of a map that wraps) of more than 20 spacings. flight_z:
  /// height while it flies [m]; 0 on the ground.
  void add(core::Vec2 position, double flight_z = 0.0) {
    if (!points_.empty()) {
      const core::Vec2 step = position - points_.back();
      const double squared = core::dot(step, step);
      if (squared < spacing_ * spacing_) return;
      if (squared > 400.0 * spacing_ * spacing_) points_.clear(), flights_.clear();
    }
    if (points_.size() == kPoints) points_.erase(points_.begin()), flights_.erase(flights_.begin());
    points_.push_back(position);
    flights_.push_back(flight_z);
  }

  /// Oldest first.
  [[nodiscard]] const std::vector<core::Vec2>& points() const { return points_; }
  /// Of each point, as it was added.
  [[nodiscard]] const std::vector<double>& flights() const { return flights_; }

 private:
  double spacing_;
  std::vector<core::Vec2> points_;
  std::vector<double> flights_;
};

}  // namespace woodlouse::client
