// The bicubic spline through a height grid: the global tensor-product spline of chapter 5 of the document,
// with every cell's 16 coefficients computed once, so that an evaluation is O(1) instead of O(n).
//
// In cell (i, j), with u = x - x_i, v = y - y_j:
//     z = sum c[b][a] u^a v^b,  a, b = 0..3
// The coefficients come from four one-dimensional spline passes (de Boor, 1962): zx along rows, zy along
// columns, zxy along columns of zx; then each cell is the Hermite interpolant of its corners' z, zx, zy, zxy.
//
// Continuity: C2 everywhere inside the domain. Exact on bicubic polynomials with not-a-knot ends.
// Ends: not-a-knot (default; order 4 up to the rim) or natural (the document's: curvature zero at the ends,
//   which costs two orders near the rim), or periodic (C2 over the seam too), each axis its own. Periodic:
//   the grid holds the seam twice, its last column (row) is the first again, so that its domain is one
//   period; wrapped_surface.h takes points of any turn.
// Outside the domain: the edge cell's polynomial goes on (see surface.h); over a seam the surface itself goes
// on
//   for kBeyondSeam cells, whose polynomials are kept twice, and the last of them from there.
// Memory: 128 bytes a cell. Cost: about 15 ns for z, gradient and Hessian while the cells fit the cache.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "shared/terrain/height_grid.h"
#include "shared/terrain/spline_1d.h"
#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

/// z, gradient and Hessian of one cell's polynomial at (u, v); c[4 b + a] multiplies u^a v^b.
/// Nested Horner: the sums that give the value give the derivatives too. T: double, or several
/// (core/lanes.h).
template <typename T>
[[gnu::always_inline]] inline BasicSurfaceSample<T> evaluate_cell(const T* c, T u, T v) {
  T p[4];  // in v, for the four powers of u: the value,
  T d[4];  // d/dv,
  T e[4];  // and half of d2/dv2
  for (std::size_t k = 0; k < 4; ++k) {
    const T p2 = c[12 + k] * v + c[8 + k];
    const T p1 = p2 * v + c[4 + k];
    const T d1 = c[12 + k] * v + p2;
    p[k] = p1 * v + c[k];
    d[k] = d1 * v + p1;
    e[k] = c[12 + k] * v + d1;
  }
  BasicSurfaceSample<T> s;
  const T z2 = p[3] * u + p[2];
  const T z1 = z2 * u + p[1];
  const T zx1 = p[3] * u + z2;
  s.z = z1 * u + p[0];
  s.zx = zx1 * u + z1;
  s.zxx = T(2.0) * (p[3] * u + zx1);
  const T zy2 = d[3] * u + d[2];
  const T zy1 = zy2 * u + d[1];
  s.zy = zy1 * u + d[0];
  s.zxy = (d[3] * u + zy2) * u + zy1;
  s.zyy = T(2.0) * (((e[3] * u + e[2]) * u + e[1]) * u + e[0]);
  return s;
}

class BicubicSpline {
 public:
  /// The numbers an evaluation reads, for batched steps; valid as long as the spline.
  struct View {
    const double* cells;  ///< 16 a cell, row by row
    double x_origin, y_origin, dx, dy, inverse_dx, inverse_dy;
    int last_column, last_row;
  };

  /// REQUIRES at least 4 knots each way for not-a-knot and periodic, 2 for natural, finite heights, spacings
  /// > 0; along a periodic axis seam_mismatch() within 1e-9 of the heights' range (the first column or row is
  /// taken for the last).
  explicit BicubicSpline(const HeightGrid& grid, SplineEnds ends = SplineEnds::kNotAKnot);
  BicubicSpline(const HeightGrid& grid, SplineEnds x_ends, SplineEnds y_ends);

  [[nodiscard]] SurfaceSample sample(double x, double y) const;
  [[nodiscard]] Rectangle domain() const { return domain_; }
  [[nodiscard]] double cell() const { return dx_ < dy_ ? dx_ : dy_; }
  /// Which polynomial holds at a point, its bounds, and its values wherever asked: for integrators that keep
  /// to one cell through a step.
  struct CellIndex {
    long long column = 0;
    long long row = 0;
  };
  /// How many cells are kept beyond each seam of a periodic axis: a sub-step looks one cell's way past it,
  /// and as far as the acceleration takes it.
  static constexpr std::size_t kBeyondSeam = 4;
  /// How many there are in the domain, each way. cell_at() gives the same polynomial a period on as that many
  /// cells on.
  [[nodiscard]] CellIndex cells() const { return cells_each_way_; }
  [[nodiscard, gnu::always_inline]] inline CellIndex cell_at(double x, double y) const {
    return {cell_index((x - x_origin_) * inverse_dx_, last_column_),
            cell_index((y - y_origin_) * inverse_dy_, last_row_)};
  }
  [[nodiscard]] Rectangle bounds(CellIndex cell) const {
    const double x = x_origin_ + static_cast<double>(cell.column) * dx_;
    const double y = y_origin_ + static_cast<double>(cell.row) * dy_;
    return {x, y, x + dx_, y + dy_};
  }
  [[nodiscard, gnu::always_inline]] inline SurfaceSample sample_in(CellIndex cell, double x, double y) const {
    return polynomial(nearest_cell(cell.column, cell.row), x, y);
  }

  [[nodiscard]] View view() const {
    return {cells_.front().c.data(),
            x_origin_,
            y_origin_,
            dx_,
            dy_,
            inverse_dx_,
            inverse_dy_,
            static_cast<int>(last_column_),
            static_cast<int>(last_row_)};
  }

 private:
  /// Looked at before the conversion, for which no number may be too large; NaN gives cell 0.
  [[gnu::always_inline]] static inline long long cell_index(double u, long long last) {
    if (!(std::fabs(u) < 0x1p62)) [[unlikely]]
      return u > 0.0 ? last : 0;
    const auto index = static_cast<long long>(u);
    return index < 0 ? 0 : (index > last ? last : index);
  }
  /// Copies the domain's cells to those stored beyond its seams; it begins at that column and row.
  void repeat_beyond_seams(std::size_t first_column, std::size_t first_row);

  /// Of a cell that is stored.
  [[nodiscard, gnu::always_inline]] inline SurfaceSample polynomial(CellIndex cell, double x,
                                                                    double y) const {
    return evaluate_cell(
        cells_[static_cast<std::size_t>(cell.row * (last_column_ + 1) + cell.column)].c.data(),
        x - x_origin_ - static_cast<double>(cell.column) * dx_,
        y - y_origin_ - static_cast<double>(cell.row) * dy_);
  }
  [[nodiscard, gnu::always_inline]] inline CellIndex nearest_cell(long long i, long long j) const {
    return {i < 0 ? 0 : (i > last_column_ ? last_column_ : i), j < 0 ? 0 : (j > last_row_ ? last_row_ : j)};
  }

  /// c[4 b + a] multiplies u^a v^b. Two cache lines.
  struct alignas(64) Cell {
    std::array<double, 16> c;
  };

  Rectangle domain_;
  CellIndex cells_each_way_;
  double x_origin_;  ///< the first stored cell's corner: beyond the seam along a periodic axis
  double y_origin_;
  double dx_;
  double dy_;
  double inverse_dx_;
  double inverse_dy_;
  long long last_column_;  ///< index of the last stored cell in x
  long long last_row_;
  std::vector<Cell> cells_;
};

/// The largest difference [m] between the first and the last column, and row: what keeps a grid from being
/// periodic.
struct SeamMismatch {
  double x = 0.0;
  double y = 0.0;
};
SeamMismatch seam_mismatch(const HeightGrid& grid);

// Inline: this is the inner loop of everything.
[[gnu::always_inline]] inline SurfaceSample BicubicSpline::sample(double x, double y) const {
  return polynomial(cell_at(x, y), x, y);
}

}  // namespace woodlouse::terrain
