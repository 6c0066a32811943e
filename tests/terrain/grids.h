// Grids and points for the tests of surfaces.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>

#include "shared/core/random.h"
#include "shared/terrain/height_grid.h"

namespace woodlouse::tests {

/// Heights f(x, y) on columns x rows knots; axes that differ in origin and spacing.
template <typename F>
terrain::HeightGrid grid_of(std::size_t columns, std::size_t rows, const F& f) {
  terrain::HeightGrid grid{columns, rows, -1.5, 2.25, 0.5, 0.25, {}};
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      grid.heights.push_back(f(grid.x_origin + static_cast<double>(i) * grid.dx,
                               grid.y_origin + static_cast<double>(j) * grid.dy));
    }
  }
  return grid;
}

inline terrain::HeightGrid random_grid(std::size_t columns, std::size_t rows, std::uint64_t seed) {
  core::Random random(seed);
  return grid_of(columns, rows, [&](double, double) { return random.uniform(); });
}

/// Smooth enough for differences, rough enough to tell stencils apart.
inline terrain::HeightGrid smooth_grid(std::size_t columns, std::size_t rows) {
  return grid_of(columns, rows, [](double x, double y) {
    return std::sin(0.9 * x + 0.3) * std::cos(1.1 * y) + 0.2 * x * y;
  });
}

/// Calls use(x, y) at `count` random points of the rectangle.
template <typename F>
void at_random_points(const terrain::Rectangle& r, int count, std::uint64_t seed, const F& use) {
  core::Random random(seed);
  for (int k = 0; k < count; ++k) {
    const double x = r.x_min + (r.x_max - r.x_min) * random.uniform();
    const double y = r.y_min + (r.y_max - r.y_min) * random.uniform();
    use(x, y);
  }
}

/// A grid's point as a fraction of its cell: column and row with their fractions.
inline std::pair<double, double> in_knots(const terrain::HeightGrid& grid, double x, double y) {
  return {(x - grid.x_origin) / grid.dx, (y - grid.y_origin) / grid.dy};
}

/// How far a number is from the next whole or half one.
inline double to_half(double t) { return std::fabs(2.0 * t - std::round(2.0 * t)) / 2.0; }

}  // namespace woodlouse::tests
