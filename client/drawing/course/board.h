// What a mode says over the picture: its lines, big figures, the podium.
#pragma once

#include <optional>

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/course/course.h"
#include "client/drawing/layout.h"
#include "client/drawing/palette.h"
#include "client/drawing/scene.h"
#include "client/ground/map_camera.h"

namespace woodlouse::client {

/// A tone in a look, on the ground that `base` has.
Style tone_style(Tone tone, const Style& base, const Look& look);

/// How many rows Scene::course's lines take beside a panel, `columns` wide: as many for one line as for two,
/// that the map stays as large when a round begins.
LineRows line_rows(const Scene& scene, int columns);

/// Scene::course's lines, and over the map its big figures or its podium. Of a line what fits is shown, part
/// by part: half a number would be another one. yours: the cell of the map in which your louse is drawn, over
/// which no figure stands; none: it is nowhere.
void draw_course_board(const Scene& scene, const Badges& badges, const Layout& layout,
                       std::optional<Place> yours, CellBuffer& cells);

}  // namespace woodlouse::client
