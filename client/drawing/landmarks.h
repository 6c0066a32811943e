// What a map has besides its ground, in every look: what a louse meets at the edge, and what pulls it to the
// middle. It stands still, so it is painted once, into the picture of the ground.
#pragma once

#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/drawing/scene.h"
#include "client/drawing/terrain_oblique_view.h"
#include "client/ground/map_camera.h"
#include "client/ground/oblique_camera.h"
#include "client/ground/relief.h"

namespace woodlouse::client {

/// What a picture from above leaves free around the map, so that its edge is seen.
inline constexpr Margin kCharacterMargin{1.0, 1.0};
inline constexpr Margin kPixelMargin{1.0, 0.5};

/// Edges as `#` walls, `:` that wrap, `.` where the ground ends; `(*)` what pulls. `cells`:
/// contour_layer()'s.
void mark_in_characters(const Landmarks& landmarks, const terrain::Rectangle& domain, const MapCamera& camera,
                        Size size, const Look& look, std::vector<Cell>& cells);

/// Edges as a line, dashed where they wrap, none where the ground ends; a sun that pulls. `cells`:
/// top_layer()'s.
void mark_in_pixels(const Landmarks& landmarks, const terrain::Rectangle& domain, const MapCamera& camera,
                    Size size, std::vector<Cell>& cells);

/// The same before a camera: walls stand upright and are hidden by the hills before them.
void mark_obliquely(const Landmarks& landmarks, const Relief& relief, const ObliqueCamera& camera,
                    ObliqueLayer& layer);

}  // namespace woodlouse::client
