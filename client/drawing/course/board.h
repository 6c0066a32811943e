// What a mode says over the picture: its lines, big figures, the podium.
#pragma once

#include <optional>
#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/course/course.h"
#include "client/drawing/layout.h"
#include "client/drawing/palette.h"
#include "client/drawing/scene.h"
#include "client/ground/map_camera.h"

namespace woodlouse::client {

/// What is not to be hidden, in cells from the map's corner.
struct InSight {
  std::optional<Place> yours;  ///< where your louse is drawn; none: it is nowhere
  std::vector<Viewport> gate;  ///< the next one's line, posts and number
};

/// A tone in a look, on the ground that `base` has.
Style tone_style(Tone tone, const Style& base, const Look& look);

/// How many rows Scene::course's lines take beside a panel, `columns` wide: as many for one line as for two,
/// that the map stays as large when a round begins.
LineRows line_rows(const Scene& scene, int columns);

/// Scene::course's lines, and over the map its big figures or its podium. Of a line what fits is shown, part
/// by part: half a number would be another one. Over your louse no figure stands.
void draw_course_board(const Scene& scene, const Badges& badges, const Layout& layout,
                       const InSight& in_sight, CellBuffer& cells);

}  // namespace woodlouse::client
