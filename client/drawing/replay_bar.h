// What a recording has on the screen besides a game's: its status line, the scrubber with event signs, its
// keys.
#pragma once

#include "client/cells/cell_buffer.h"
#include "client/drawing/layout.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

// All REQUIRE scene.replay.

/// The file, the lice, the length, what is proven.
void draw_replay_status_line(const Scene& scene, CellBuffer& cells);

/// Playing or paused, the time, how far it is and where things happened, the length, the speed.
void draw_scrubber(const Scene& scene, const Layout& layout, CellBuffer& cells);

/// The keys.
void draw_replay_key_line(const Scene& scene, const Layout& layout, CellBuffer& cells);

}  // namespace woodlouse::client
