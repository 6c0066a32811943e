#include "client/ground/follow_camera.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::client {

MapCamera FollowCamera::over(core::Vec2 louse, double zoom, Margin margin) {
  assert(zoom > 0.0);
  zoom_to(zoom);
  const terrain::Rectangle& d = relief_.terrain().domain();
  const double row = camera_for(d, size_, margin).row / zoom;
  // Each way by itself: along a wall the louse stays off the middle for long.
  const auto next = [](double at, std::optional<double> now, double half, double cell, double low,
                       double high) {
    if (now && std::abs(at - *now) < kLeaves * half) return *now;
    const double reach = half - cell;
    const double full =
        high - low <= 2.0 * reach ? (low + high) / 2.0 : std::clamp(at, low + reach, high - reach);
    return std::abs(at - full) < half ? full : at;  // far beyond an open edge nothing keeps the picture
  };
  const auto x = over_ ? std::optional(over_->x) : std::nullopt;
  const auto y = over_ ? std::optional(over_->y) : std::nullopt;
  over_ =
      core::Vec2{next(louse.x, x, row * size_.columns / 4.0, margin.columns * row / 2.0, d.x_min, d.x_max),
                 next(louse.y, y, row * size_.rows / 2.0, margin.rows * row, d.y_min, d.y_max)};
  return camera_around(*over_, row, size_);
}

const ObliqueCamera& FollowCamera::whole() {
  if (!whole_) whole_ = oblique_camera_for(relief_, size_);
  return *whole_;
}

ObliqueCamera FollowCamera::around(Vec3 centre, double zoom) {
  return oblique_camera_around(whole(), centre, zoom, size_);
}

double FollowCamera::off_middle(const ObliqueCamera& camera, Vec3 louse) const {
  const auto at = camera.project(louse);
  if (!at) return 2.0;
  return std::max(std::abs(at->x / (0.5 * size_.columns) - 1.0), std::abs(at->y / size_.rows - 1.0));
}

ObliqueCamera FollowCamera::before(Vec3 louse, double zoom) {
  assert(zoom > 0.0);
  zoom_to(zoom);
  if (before_) {
    const ObliqueCamera standing = around(*before_, zoom);
    if (off_middle(standing, louse) < kLeaves) return standing;
  }
  const terrain::Rectangle& d = relief_.terrain().domain();
  const double half_width = (d.x_max - d.x_min) / (2.0 * std::max(1.0, zoom));
  const double half_depth = (d.y_max - d.y_min) / (2.0 * std::max(1.0, zoom));
  const core::Vec2 full{std::clamp(louse.x, d.x_min + half_width, d.x_max - half_width),
                        std::clamp(louse.y, d.y_min + half_depth, d.y_max - half_depth)};
  const Vec3 inside{full.x, full.y, relief_.sample(full).z * relief_.exaggeration()};
  constexpr int kSteps = 4;
  for (int i = 0;; ++i) {
    before_ = inside + (static_cast<double>(i) / kSteps) * (louse - inside);
    const ObliqueCamera camera = around(*before_, zoom);
    if (i == kSteps || off_middle(camera, louse) <= kStands) return camera;
  }
}

}  // namespace woodlouse::client
