// The ground along a louse's heading, from the side: whether a hill is ahead that a push can't climb.
#pragma once

#include "client/drawing/frame_box.h"
#include "client/drawing/palette.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// Of your louse, in `rows` rows of the panel: ground that a full push does not climb from rest is `^` (and
/// in warning's colour), other ground `#` or filled; where the louse stands a `@`, above its column.
/// REQUIRES rows >= 3, a scene with a terrain and your louse.
void draw_profile(const Scene& scene, const LouseMark& you, const Styles& styles, int rows, PanelWriter& out);

/// How far it looks ahead [m].
double profile_reach(const Scene& scene);

}  // namespace woodlouse::client
