// What a mode says over the picture: its lines, big figures, the podium.
#pragma once

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/course/course.h"
#include "client/drawing/layout.h"
#include "client/drawing/palette.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// A tone in a look, on the ground that `base` has.
Style tone_style(Tone tone, const Style& base, const Look& look);

/// Scene::course's lines over the map's first rows, its big figures below them, its podium.
void draw_course_board(const Scene& scene, const Badges& badges, const Viewport& map, CellBuffer& cells);

}  // namespace woodlouse::client
