// A mode's marks in the picture: gates as posts with a dashed line between, crumbs, rings, ghosts in outline,
// an arrow to where one is wanted.
#pragma once

#include <vector>

#include "client/drawing/badges.h"
#include "client/drawing/course/ground_canvas.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// What lies on the ground; before the lice are drawn.
void draw_marks(const Scene& scene, const Badges& badges, GroundCanvas& canvas);

/// Where names and big figures would hide the next gate: its line, around its posts, where its number goes.
std::vector<Viewport> next_gate_cells(const Scene& scene, const GroundCanvas& canvas);

/// The next gate's posts once more, where the canvas keeps nothing.
void draw_next_gate_over_lice(const Scene& scene, GroundCanvas& canvas);

/// Numbers, names and arrows: over the lice in a picture of pixels, where what stands is kept. next_gate: its
/// cells, over which only its own number is written there.
void draw_mark_labels(const Scene& scene, const Badges& badges, const std::vector<Viewport>& next_gate,
                      GroundCanvas& canvas);

}  // namespace woodlouse::client
