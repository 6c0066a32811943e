// Heights on a rectangular grid of knots: the data every interpolation begins with.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

/// columns x rows heights [m]. Knot (i, j) lies at (x_origin + i * dx, y_origin + j * dy); heights are stored
/// row by row from south to north, each from west to east: heights[j * columns + i].
struct HeightGrid {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double x_origin = 0.0;
  double y_origin = 0.0;
  double dx = 1.0;  ///< > 0 [m]
  double dy = 1.0;  ///< > 0 [m]
  std::vector<double> heights;
  friend bool operator==(const HeightGrid&, const HeightGrid&) = default;

  [[nodiscard]] double at(std::size_t i, std::size_t j) const {
    assert(i < columns && j < rows);
    return heights[j * columns + i];
  }
  [[nodiscard]] Rectangle domain() const {
    return {x_origin, y_origin, x_origin + static_cast<double>(columns - 1) * dx,
            y_origin + static_cast<double>(rows - 1) * dy};
  }
};

}  // namespace woodlouse::terrain
