// A plane: flat ground, level or inclined. Exact; no cells, no curvature, and its samples have none, so that
// nobody computes with it (chapters 2.1 and 2.3 of the document move on such ground).
//     z = height + slope . (p - corner)
// Continuity: C-infinity. Outside the domain: the plane goes on.
#pragma once

#include <limits>
#include <optional>

#include "shared/core/vec2.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

class PlaneSurface {
 public:
  /// height [m]: at the domain's south-western corner.
  PlaneSurface(const Rectangle& domain, double height, core::Vec2 slope)
      : domain_(domain), height_(height), slope_(slope) {}

  [[nodiscard, gnu::always_inline]] inline SlopeSample sample(double x, double y) const {
    return {height_ + slope_.x * (x - domain_.x_min) + slope_.y * (y - domain_.y_min), slope_.x, slope_.y};
  }
  [[nodiscard]] Rectangle domain() const { return domain_; }
  [[nodiscard]] double cell() const { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] core::Vec2 slope() const { return slope_; }

 private:
  Rectangle domain_;
  double height_;
  core::Vec2 slope_;
};

/// The plane that all knots of a grid lie in, to the rounding of their heights; none where one does not.
/// Every spline through such heights is this plane. REQUIRES at least 2 knots each way.
std::optional<PlaneSurface> plane_through(const HeightGrid& grid);

}  // namespace woodlouse::terrain
