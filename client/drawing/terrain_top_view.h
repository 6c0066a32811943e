// The map in half-block pixels, from above: elevation colours, light and shadow, thin contours; or the length
// of the gradient, which shows at a glance whether normals are continuous.
#pragma once

#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"
#include "client/ground/map_camera.h"
#include "client/ground/relief.h"

namespace woodlouse::client {

enum class Paint { kElevation, kSteepness };

/// What `camera` sees in `size` cells, row by row.
std::vector<Cell> top_layer(const Relief& relief, const MapCamera& camera, Size size, ColorMode mode,
                            Paint paint);

/// How much darker a contour line is, given the rise across one pixel: 1 where there is none. Lines nearer
/// than 3 pixels are thinned to every second, fourth, ... one; on nearly level ground there are twice as
/// many. `z` here, `z_right` and `z_below` one pixel on.
double contour_shade(double z, double z_right, double z_below, double interval);

}  // namespace woodlouse::client
