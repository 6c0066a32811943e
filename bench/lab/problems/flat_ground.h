// Flat ground with lines of knots through the centre, as the shipped map of central gravity has them.
#pragma once

#include "shared/document/surface_catalogue.h"

namespace woodlouse::lab {

inline document::AnySurface flat_ground() {
  terrain::HeightGrid grid;
  grid.columns = grid.rows = 5;
  grid.x_origin = grid.y_origin = -20.0;
  grid.dx = grid.dy = 10.0;
  grid.heights.assign(25, 0.0);
  return terrain::BicubicSpline(grid);
}

}  // namespace woodlouse::lab
