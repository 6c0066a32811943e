#include "shared/terrain/bicubic_spline.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::terrain {
namespace {

using Field = std::vector<double>;  // one value a knot, laid out as HeightGrid::heights

Field slopes_along_rows(const Field& values, std::size_t columns, std::size_t rows, double spacing,
                        SplineEnds ends) {
  Field result(values.size());
  for (std::size_t j = 0; j < rows; ++j) {
    spline_slopes(std::span(values).subspan(j * columns, columns), spacing, ends,
                  std::span(result).subspan(j * columns, columns));
  }
  return result;
}

Field slopes_along_columns(const Field& values, std::size_t columns, std::size_t rows, double spacing,
                           SplineEnds ends) {
  Field result(values.size());
  Field line(rows);
  Field slopes(rows);
  for (std::size_t i = 0; i < columns; ++i) {
    for (std::size_t j = 0; j < rows; ++j) line[j] = values[j * columns + i];
    spline_slopes(line, spacing, ends, slopes);
    for (std::size_t j = 0; j < rows; ++j) result[j * columns + i] = slopes[j];
  }
  return result;
}

/// The cubic a0 + a1 t + a2 t^2 + a3 t^3 on [0, h] with values f0, f1 and slopes d0, d1 at its ends.
std::array<double, 4> hermite(double f0, double f1, double d0, double d1, double inverse_h) {
  const double secant = (f1 - f0) * inverse_h;
  return {f0, d0, (3.0 * secant - 2.0 * d0 - d1) * inverse_h,
          (d0 + d1 - 2.0 * secant) * inverse_h * inverse_h};
}

std::size_t beyond(SplineEnds ends) { return ends == SplineEnds::kPeriodic ? BicubicSpline::kBeyondSeam : 0; }

double range_of(const Field& heights) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return *high - *low;
}

/// The heights with the seam's knots equal bit for bit along periodic axes.
Field closed_heights(const HeightGrid& grid, SplineEnds x_ends, SplineEnds y_ends) {
  Field z = grid.heights;
  if (x_ends == SplineEnds::kPeriodic) {
    assert(seam_mismatch(grid).x <= 1e-9 * range_of(z));
    for (std::size_t j = 0; j < grid.rows; ++j) z[(j + 1) * grid.columns - 1] = z[j * grid.columns];
  }
  if (y_ends == SplineEnds::kPeriodic) {
    assert(seam_mismatch(grid).y <= 1e-9 * range_of(z));
    std::copy_n(z.begin(), grid.columns, z.end() - static_cast<std::ptrdiff_t>(grid.columns));
  }
  return z;
}

}  // namespace

SeamMismatch seam_mismatch(const HeightGrid& grid) {
  SeamMismatch worst;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    worst.x = std::fmax(worst.x, std::fabs(grid.at(grid.columns - 1, j) - grid.at(0, j)));
  }
  for (std::size_t i = 0; i < grid.columns; ++i) {
    worst.y = std::fmax(worst.y, std::fabs(grid.at(i, grid.rows - 1) - grid.at(i, 0)));
  }
  return worst;
}

BicubicSpline::BicubicSpline(const HeightGrid& grid, SplineEnds ends) : BicubicSpline(grid, ends, ends) {}

BicubicSpline::BicubicSpline(const HeightGrid& grid, SplineEnds x_ends, SplineEnds y_ends)
    : domain_(grid.domain()),
      cells_each_way_{static_cast<long long>(grid.columns) - 1, static_cast<long long>(grid.rows) - 1},
      x_origin_(grid.x_origin - static_cast<double>(beyond(x_ends)) * grid.dx),
      y_origin_(grid.y_origin - static_cast<double>(beyond(y_ends)) * grid.dy),
      dx_(grid.dx),
      dy_(grid.dy),
      inverse_dx_(1.0 / grid.dx),
      inverse_dy_(1.0 / grid.dy),
      last_column_(static_cast<long long>(grid.columns + 2 * beyond(x_ends)) - 2),
      last_row_(static_cast<long long>(grid.rows + 2 * beyond(y_ends)) - 2) {
  assert(grid.heights.size() == grid.columns * grid.rows);
  const std::size_t columns = grid.columns;
  const std::size_t rows = grid.rows;
  const bool wraps = x_ends == SplineEnds::kPeriodic || y_ends == SplineEnds::kPeriodic;
  const Field closed = wraps ? closed_heights(grid, x_ends, y_ends) : Field{};
  const Field& z = wraps ? closed : grid.heights;
  const Field zx = slopes_along_rows(z, columns, rows, dx_, x_ends);
  const Field zy = slopes_along_columns(z, columns, rows, dy_, y_ends);
  const Field zxy = slopes_along_columns(zx, columns, rows, dy_, y_ends);

  const std::size_t first_column = beyond(x_ends);
  const std::size_t first_row = beyond(y_ends);
  const std::size_t stored_columns = columns - 1 + 2 * first_column;
  cells_.resize(stored_columns * (rows - 1 + 2 * first_row));
  for (std::size_t j = 0; j + 1 < rows; ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const std::size_t k00 = j * columns + i;
      const std::size_t k10 = k00 + 1;
      const std::size_t k01 = k00 + columns;
      const std::size_t k11 = k01 + 1;
      // Cubics in u for value and y-slope along the cell's south and north edges, then in v between them.
      const auto south = hermite(z[k00], z[k10], zx[k00], zx[k10], inverse_dx_);
      const auto north = hermite(z[k01], z[k11], zx[k01], zx[k11], inverse_dx_);
      const auto south_y = hermite(zy[k00], zy[k10], zxy[k00], zxy[k10], inverse_dx_);
      const auto north_y = hermite(zy[k01], zy[k11], zxy[k01], zxy[k11], inverse_dx_);
      Cell& cell = cells_[(first_row + j) * stored_columns + first_column + i];
      for (std::size_t a = 0; a < 4; ++a) {
        const auto column = hermite(south[a], north[a], south_y[a], north_y[a], inverse_dy_);
        for (std::size_t b = 0; b < 4; ++b) cell.c[4 * b + a] = column[b];
      }
    }
  }
  if (wraps) repeat_beyond_seams(first_column, first_row);
}

void BicubicSpline::repeat_beyond_seams(std::size_t first_column, std::size_t first_row) {
  const auto columns = static_cast<std::size_t>(cells_each_way_.column);
  const auto rows = static_cast<std::size_t>(cells_each_way_.row);
  const std::size_t stored_columns = columns + 2 * first_column;
  for (std::size_t j = 0; j < rows + 2 * first_row; ++j) {
    const std::size_t own_row = first_row + (j + rows * kBeyondSeam - first_row) % rows;
    for (std::size_t i = 0; i < stored_columns; ++i) {
      const std::size_t own_column = first_column + (i + columns * kBeyondSeam - first_column) % columns;
      cells_[j * stored_columns + i] = cells_[own_row * stored_columns + own_column];
    }
  }
}

}  // namespace woodlouse::terrain
