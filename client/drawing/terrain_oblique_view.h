// The map in half-block pixels, seen from a height: light, cast shadow, elevation colours, contours; trails
// and lice are hidden by the hills before them.
#pragma once

#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/labels.h"
#include "client/drawing/layout.h"
#include "client/drawing/scene.h"
#include "client/ground/oblique_camera.h"
#include "client/ground/relief.h"

namespace woodlouse::client {

/// What does not move: computed once per map, camera and size.
struct ObliqueLayer {
  Size size;
  std::vector<Cell> cells;
  std::vector<float> depth;  ///< of each pixel, row by row; infinite for the sky
};

ObliqueLayer oblique_layer(const Relief& relief, const ObliqueCamera& camera, Size size, ColorMode mode);

/// Trails, lice as ellipsoids, names where `labels` has room. `layer` has been copied to the viewport.
void draw_lice_obliquely(const Scene& scene, const Badges& badges, const Relief& relief,
                         const ObliqueCamera& camera, const ObliqueLayer& layer, const Viewport& viewport,
                         LabelPlacer& labels, CellBuffer& cells);

}  // namespace woodlouse::client
