// A mode's marks in the picture: gates as posts with a dashed line between, crumbs, rings, ghosts in outline,
// an arrow to where one is wanted.
#pragma once

#include "client/drawing/badges.h"
#include "client/drawing/course/ground_canvas.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// What lies on the ground; before the lice are drawn.
void draw_marks(const Scene& scene, const Badges& badges, GroundCanvas& canvas);

/// Numbers, names and arrows: over the lice in a picture of pixels, where what stands is kept.
void draw_mark_labels(const Scene& scene, const Badges& badges, GroundCanvas& canvas);

}  // namespace woodlouse::client
