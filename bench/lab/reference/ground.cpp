#include "bench/lab/reference/ground.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <variant>

namespace woodlouse::lab::reference {
namespace {

/// Sums over the powers of a place: what derivatives make 0 or 1 of them is no factor.
class Powers {
 public:
  explicit Powers(Real u)
      : u_(u), uu_(u * u), uuu_(u * u * u), twice_(2 * u), thrice_(3 * u * u), six_(6 * u) {}
  template <typename Row>
  [[nodiscard]] Real sum(const Row& c) const {
    return c[0] + c[1] * u_ + c[2] * uu_ + c[3] * uuu_;
  }
  template <typename Row>
  [[nodiscard]] Real slope(const Row& c) const {
    return c[1] + c[2] * twice_ + c[3] * thrice_;
  }
  template <typename Row>
  [[nodiscard]] Real bend(const Row& c) const {
    return 2 * c[2] + c[3] * six_;
  }

 private:
  Real u_, uu_, uuu_, twice_, thrice_, six_;
};

}  // namespace

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
  const Powers of_u(u), of_v(v);
  std::array<Real, 4> values, slopes, bends;  // of the rows, along x
  for (std::size_t b = 0; b < 4; ++b) {
    const double* const of_row = c + 4 * b;
    values[b] = of_u.sum(of_row);
    slopes[b] = of_u.slope(of_row);
    bends[b] = of_u.bend(of_row);
  }
  return {of_v.sum(values), of_v.sum(slopes),   of_v.slope(values),
          of_v.sum(bends),  of_v.slope(slopes), of_v.bend(values)};
}

}  // namespace woodlouse::lab::reference
