// From above: which point of the world a cell shows. North is up, a column is half as wide as a row is high.
#pragma once

#include <algorithm>
#include <cmath>

#include "client/cells/cell_buffer.h"
#include "shared/core/vec2.h"
#include "shared/terrain/surface.h"

namespace woodlouse::client {

/// A cell, or a pixel, counted from the upper left corner of the picture.
struct Place {
  int column = 0;
  int row = 0;
  friend constexpr bool operator==(Place, Place) = default;
};

/// The cells whose middles lie in a rectangle of the world: both ends are among them.
struct CellRange {
  Place first;
  Place last;

  [[nodiscard]] constexpr bool holds(Place p) const {
    return p.column >= first.column && p.column <= last.column && p.row >= first.row && p.row <= last.row;
  }
  [[nodiscard]] constexpr Place nearest(Place p) const {
    return {std::max(first.column, std::min(p.column, last.column)),
            std::max(first.row, std::min(p.row, last.row))};
  }
};

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

  /// The cells that show a part of the world. rows: 1, or 2 for pixels, of which a row has two.
  [[nodiscard]] CellRange cells_of(const terrain::Rectangle& part, double rows = 1.0) const {
    // An edge on a middle, up to rounding, belongs to the cell.
    const auto first = [](double edge) { return static_cast<int>(std::ceil(edge - 0.5 - 1e-9)); };
    const auto last = [](double edge) { return static_cast<int>(std::floor(edge - 0.5 + 1e-9)); };
    return {{first(column_of({part.x_min, 0.0})), first(rows * row_of({0.0, part.y_max}))},
            {last(column_of({part.x_max, 0.0})), last(rows * row_of({0.0, part.y_min}))}};
  }

  /// The cell of what lies at `p`. On the map it is one that shows ground: who leans on a wall is not in it.
  [[nodiscard]] Place cell_of(core::Vec2 p, const terrain::Rectangle& domain) const {
    const auto whole = [](double value) {
      return value >= -1e6 ? static_cast<int>(std::floor(std::min(value, 1e6))) : -1'000'000;  // NaN, too
    };
    const Place place{whole(column_of(p)), whole(row_of(p))};
    return domain.contains(p.x, p.y) ? cells_of(domain).nearest(place) : place;
  }

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

/// What is left free around the whole map, for its walls [columns, rows].
struct Margin {
  double columns = 0.0;
  double rows = 0.0;
};

/// The whole of `domain` in `size` cells.
constexpr MapCamera camera_for(const terrain::Rectangle& domain, Size size, Margin margin) {
  const double width = domain.x_max - domain.x_min;
  const double height = domain.y_max - domain.y_min;
  const double row = std::max(height / std::max(1.0, size.rows - 2.0 * margin.rows),
                              2.0 * width / std::max(1.0, size.columns - 2.0 * margin.columns));
  return camera_around({(domain.x_min + domain.x_max) / 2.0, (domain.y_min + domain.y_max) / 2.0}, row, size);
}

}  // namespace woodlouse::client
