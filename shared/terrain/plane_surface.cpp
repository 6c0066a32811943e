#include "shared/terrain/plane_surface.h"

#include <cassert>

#include "shared/core/lanes.h"

namespace woodlouse::terrain {

std::optional<PlaneSurface> plane_through(const HeightGrid& grid) {
  assert(grid.columns >= 2 && grid.rows >= 2);
  const std::size_t east = grid.columns - 1;
  const std::size_t north = grid.rows - 1;
  const Rectangle domain = grid.domain();
  const double corner = grid.at(0, 0);
  const PlaneSurface plane(domain, corner,
                           {(grid.at(east, 0) - corner) / (domain.x_max - domain.x_min),
                            (grid.at(0, north) - corner) / (domain.y_max - domain.y_min)});
  double largest = 0.0;  // of a plane's heights: at a corner
  for (const double height : {corner, grid.at(east, 0), grid.at(0, north), grid.at(east, north)}) {
    if (core::magnitude(height) > largest) largest = core::magnitude(height);
  }
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * largest;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const double x = grid.x_origin + static_cast<double>(i) * grid.dx;
      const double y = grid.y_origin + static_cast<double>(j) * grid.dy;
      if (!(core::magnitude(grid.at(i, j) - plane.sample(x, y).z) <= rounding)) return std::nullopt;
    }
  }
  return plane;
}

}  // namespace woodlouse::terrain
