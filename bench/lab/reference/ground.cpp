#include "bench/lab/reference/ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <variant>

namespace woodlouse::lab::reference {

bool Ground::knows(const terrain::Terrain& terrain) {
  return std::holds_alternative<terrain::BicubicSpline>(terrain.surface()) ||
         std::holds_alternative<terrain::PlaneSurface>(terrain.surface());
}

Ground::Ground(const terrain::Terrain& terrain)
    : domain_(terrain.domain()),
      plane_(std::get_if<terrain::PlaneSurface>(&terrain.surface())),
      spline_(std::get_if<terrain::BicubicSpline>(&terrain.surface())) {
  assert(knows(terrain));
  if (spline_ == nullptr) return;
  const terrain::BicubicSpline::View view = spline_->view();
  first_column_ = std::llround((domain_.x_min - view.x_origin) / view.dx);
  first_row_ = std::llround((domain_.y_min - view.y_origin) / view.dy);
  columns_ = spline_->cells().column;
  rows_ = spline_->cells().row;
}

Cell Ground::numbered(long long column, long long row) const {
  assert(column >= 0 && column < columns_ && row >= 0 && row < rows_);
  Cell cell{column, row, domain_.x_min, domain_.y_min, domain_.x_max, domain_.y_max};
  if (spline_ == nullptr) return cell;
  const terrain::BicubicSpline::View view = spline_->view();
  const auto line = [](double origin, double spacing, long long number) {
    return static_cast<Real>(origin) + static_cast<Real>(number) * spacing;
  };
  if (column > 0) cell.x_min = line(view.x_origin, view.dx, first_column_ + column);
  if (row > 0) cell.y_min = line(view.y_origin, view.dy, first_row_ + row);
  if (column + 1 < columns_) cell.x_max = line(view.x_origin, view.dx, first_column_ + column + 1);
  if (row + 1 < rows_) cell.y_max = line(view.y_origin, view.dy, first_row_ + row + 1);
  return cell;
}

Cell Ground::cell_at(Real x, Real y) const {
  if (spline_ == nullptr) return numbered(0, 0);
  const terrain::BicubicSpline::View view = spline_->view();
  const auto number = [](Real from_rim, double spacing, long long count) {
    return std::clamp(static_cast<long long>(std::floor(from_rim / spacing)), 0LL, count - 1);
  };
  return numbered(number(x - domain_.x_min, view.dx, columns_), number(y - domain_.y_min, view.dy, rows_));
}

Cell Ground::next(const Cell& cell, int columns, int rows) const {
  return numbered((cell.column + columns + columns_) % columns_, (cell.row + rows + rows_) % rows_);
}

Place Ground::at(const Cell& cell, Real x, Real y) const {
  if (plane_ != nullptr) {
    const core::Vec2 slope = plane_->slope();
    return {plane_->height() + slope.x * (x - domain_.x_min) + slope.y * (y - domain_.y_min),
            slope.x,
            slope.y,
            0,
            0,
            0};
  }
  const terrain::BicubicSpline::View view = spline_->view();
  const long long column = first_column_ + cell.column;
  const long long row = first_row_ + cell.row;
  const double* const c = view.cells + 16 * (row * (view.last_column + 1) + column);
  const Real u = x - view.x_origin - static_cast<Real>(column) * view.dx;
  const Real v = y - view.y_origin - static_cast<Real>(row) * view.dy;
  // Powers and their derivatives, summed as they stand: no Horner.
  const Real power_u[] = {1, u, u * u, u * u * u};
  const Real slope_u[] = {0, 1, 2 * u, 3 * u * u};
  const Real bend_u[] = {0, 0, 2, 6 * u};
  const Real power_v[] = {1, v, v * v, v * v * v};
  const Real slope_v[] = {0, 1, 2 * v, 3 * v * v};
  const Real bend_v[] = {0, 0, 2, 6 * v};
  Place place;
  for (int b = 0; b < 4; ++b) {
    Real value = 0, slope = 0, bend = 0;
    for (int a = 0; a < 4; ++a) {
      const Real coefficient = c[4 * b + a];
      value += coefficient * power_u[a];
      slope += coefficient * slope_u[a];
      bend += coefficient * bend_u[a];
    }
    place.z += value * power_v[b];
    place.zx += slope * power_v[b];
    place.zxx += bend * power_v[b];
    place.zy += value * slope_v[b];
    place.zxy += slope * slope_v[b];
    place.zyy += value * bend_v[b];
  }
  return place;
}

}  // namespace woodlouse::lab::reference
