// Ground as steep and as sharply bent as asked for:
//     z = A cos(k x) cos(k y),  k = curvature / slope,  A = slope / k
// whose steepest slope is A k and whose sharpest curvature A k^2. Four waves wide, through a not-a-knot
// spline.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

#include "shared/core/portable_trigonometry.h"
#include "shared/document/surface_catalogue.h"

namespace woodlouse::lab {

struct EggCrate {
  document::AnySurface surface;
  terrain::Rectangle walls;
  double lowest;  ///< the lowest knot, at the bottom of a dent [m]
};

/// knots_per_wave: even, >= 4.
inline EggCrate egg_crate(double slope, double curvature, std::size_t knots_per_wave) {
  constexpr std::size_t kWaves = 4;
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  const double k = curvature / slope;
  const double amplitude = slope / k;
  const double wave = kTwoPi / k;
  terrain::HeightGrid grid;
  grid.columns = grid.rows = kWaves * knots_per_wave + 1;
  grid.dx = grid.dy = wave / static_cast<double>(knots_per_wave);
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const double u = kTwoPi * static_cast<double>(i) / static_cast<double>(knots_per_wave);
      const double v = kTwoPi * static_cast<double>(j) / static_cast<double>(knots_per_wave);
      grid.heights.push_back(amplitude * core::portable_sincos(u).cos * core::portable_sincos(v).cos);
    }
  }
  terrain::BicubicSpline spline(grid);
  const double lowest = *std::min_element(grid.heights.begin(), grid.heights.end());
  return {std::move(spline), grid.domain(), lowest};
}

}  // namespace woodlouse::lab
