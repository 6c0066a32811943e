// The map in characters: contour lines from above, for any terminal.
//
// In the cells a contour crosses stands the glyph that follows its tangent, `- _ / | \`, so that dense lines
// read as steep. Where the ground is nearly level, dashed lines at half and quarter steps show its form.
#pragma once

#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/layout.h"
#include "client/drawing/scene.h"
#include "client/ground/map_camera.h"
#include "client/ground/relief.h"

namespace woodlouse::client {

/// The contour lines of what `camera` sees in `size` cells, row by row.
std::vector<Cell> contour_layer(const Relief& relief, const MapCamera& camera, Size size, const Look& look);

/// The same ground by steepness: denser characters are steeper, relative to the map's steep parts.
std::vector<Cell> slope_character_layer(const Relief& relief, const MapCamera& camera, Size size,
                                        const Look& look);

/// Trails as dots, lice as a letter and a heading glyph with a blank halo, yours in reverse video.
void draw_lice_as_letters(const Scene& scene, const Badges& badges, const MapCamera& camera,
                          const Viewport& viewport, CellBuffer& cells);

/// `> / ^ \ < / v \` for a heading, and the cell beside the louse where it stands.
struct HeadingGlyph {
  char glyph = '>';
  int columns = 1;
  int rows = 0;
};
HeadingGlyph heading_glyph(core::Vec2 heading);

}  // namespace woodlouse::client
