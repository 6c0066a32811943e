#include "shared/document/gauss_gradient.h"

#include <algorithm>
#include <utility>

namespace woodlouse::document {
namespace {

core::Vec2 fitted_gradient(const terrain::HeightGrid& grid, std::size_t i, std::size_t j) {
  const std::size_t center_i = std::clamp<std::size_t>(i, 1, grid.columns - 2);
  const std::size_t center_j = std::clamp<std::size_t>(j, 1, grid.rows - 2);
  const auto [south, middle, north] = nine_knots(grid, center_i, center_j);
  const double west = south[0] + middle[0] + north[0];
  const double east = south[2] + middle[2] + north[2];
  const double sum_south = south[0] + south[1] + south[2];
  const double sum_north = north[0] + north[1] + north[2];
  const double a1 = (east - west) / 6.0;
  const double a2 = (sum_north - sum_south) / 6.0;
  const double a3 = (east - 2.0 * (south[1] + middle[1] + north[1]) + west) / 6.0;
  const double a5 = (sum_north - 2.0 * (middle[0] + middle[1] + middle[2]) + sum_south) / 6.0;
  const double a4 = (north[2] - north[0] - south[2] + south[0]) / 4.0;
  const double p = static_cast<double>(i) - static_cast<double>(center_i);
  const double q = static_cast<double>(j) - static_cast<double>(center_j);
  return {(a1 + 2.0 * a3 * p + a4 * q) / grid.dx, (a2 + 2.0 * a5 * q + a4 * p) / grid.dy};
}

/// The cell that holds `position` (in knot spacings), the edge's cell for points outside; NaN gives 0.
std::size_t cell_of(double position, std::size_t knots) {
  if (!(position > 0.0)) return 0;
  const std::size_t last = knots - 2;
  return position >= static_cast<double>(last) ? last : static_cast<std::size_t>(position);
}

core::Vec2 between(core::Vec2 a, core::Vec2 b, double t) { return a + t * (b - a); }

}  // namespace

GaussGradient::GaussGradient(terrain::HeightGrid grid) : height_(std::move(grid)) {
  const terrain::HeightGrid& knots = height_.grid();
  gradients_.reserve(knots.heights.size());
  for (std::size_t j = 0; j < knots.rows; ++j) {
    for (std::size_t i = 0; i < knots.columns; ++i) gradients_.push_back(fitted_gradient(knots, i, j));
  }
}

terrain::SurfaceSample GaussGradient::sample(double x, double y) const {
  const terrain::HeightGrid& grid = height_.grid();
  const double column = (x - grid.x_origin) / grid.dx;
  const double row = (y - grid.y_origin) / grid.dy;
  const std::size_t i = cell_of(column, grid.columns);
  const std::size_t j = cell_of(row, grid.rows);
  const double u = column - static_cast<double>(i);
  const core::Vec2 south = between(knot_gradient(i, j), knot_gradient(i + 1, j), u);
  const core::Vec2 north = between(knot_gradient(i, j + 1), knot_gradient(i + 1, j + 1), u);
  const core::Vec2 gradient = between(south, north, row - static_cast<double>(j));
  return {height_.sample(x, y).z, gradient.x,          gradient.y,
          terrain::kNoHessian,    terrain::kNoHessian, terrain::kNoHessian};
}

}  // namespace woodlouse::document
