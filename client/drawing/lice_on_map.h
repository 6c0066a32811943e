// Lice over the map from above, in half-block pixels: bodies where the picture is large, else letters.
#pragma once

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/labels.h"
#include "client/drawing/layout.h"
#include "client/drawing/scene.h"
#include "client/ground/map_camera.h"

namespace woodlouse::client {

inline constexpr int kColumnsForBodies = 80;  ///< of the map; below, a body would be a speck

/// Trails as pixels; lice, each with a rim and, where it flies, a shadow to the south-east as far off as it
/// is high; names where `labels` has room. From 80 columns a louse is an ellipse with a head that lies as
/// it travels, yours with a line where the next push goes; below, a letter on its colour with a heading glyph
/// beside.
void draw_lice_on_map(const Scene& scene, const Badges& badges, const MapCamera& camera,
                      const Viewport& viewport, LabelPlacer& labels, CellBuffer& cells);

}  // namespace woodlouse::client
