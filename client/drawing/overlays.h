// What lies over the play screen, and what replaces it.
#pragma once

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// The help, the scoreboard, the quit question or the lost connection, by scene.mode; nothing for the others.
void draw_overlay(const Scene& scene, const Badges& badges, CellBuffer& cells);

/// Says what size is needed. Fits any size.
void draw_too_small(const Scene& scene, CellBuffer& cells);

}  // namespace woodlouse::client
