// From above: which point of the world a cell shows. North is up, a column is half as wide as a row is high.
#pragma once

#include <algorithm>

#include "client/cells/cell_buffer.h"
#include "shared/core/vec2.h"
#include "shared/terrain/surface.h"

namespace woodlouse::client {

struct MapCamera {
  double west = 0.0;    ///< x at the left edge [m]
  double north = 0.0;   ///< y at the upper edge [m]
  double column = 1.0;  ///< width of a column [m]
  double row = 2.0;     ///< height of a row [m]

  /// The world at a place given in columns and rows from the upper left corner.
  [[nodiscard]] constexpr core::Vec2 world(double columns, double rows) const {
    return {west + columns * column, north - rows * row};
  }
  [[nodiscard]] constexpr double column_of(core::Vec2 p) const { return (p.x - west) / column; }
  [[nodiscard]] constexpr double row_of(core::Vec2 p) const { return (north - p.y) / row; }

  friend constexpr bool operator==(const MapCamera&, const MapCamera&) = default;
};

/// `size` cells with `centre` in the middle, rows `row` metres high.
constexpr MapCamera camera_around(core::Vec2 centre, double row, Size size) {
  MapCamera camera;
  camera.row = row;
  camera.column = row / 2.0;
  camera.west = centre.x - camera.column * size.columns / 2.0;
  camera.north = centre.y + camera.row * size.rows / 2.0;
  return camera;
}

/// The whole of `domain` in `size` cells.
constexpr MapCamera camera_for(const terrain::Rectangle& domain, Size size) {
  const double width = domain.x_max - domain.x_min;
  const double height = domain.y_max - domain.y_min;
  const double row = std::max(height / std::max(1, size.rows), 2.0 * width / std::max(1, size.columns));
  return camera_around({(domain.x_min + domain.x_max) / 2.0, (domain.y_min + domain.y_max) / 2.0}, row, size);
}

}  // namespace woodlouse::client
