// The lines and boxes around the map: who plays, how you move, what is said, which keys there are.
#pragma once

#include <string>
#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/drawing/badges.h"
#include "client/drawing/layout.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// "state ok 12" of a server's keys, "state ok 9f3a 600/11544" of a recording's ticks (", cut off" where it
/// has no end), or where it differs.
std::string proof_text(const StateProof& proof);

/// Game, map, lice, rank, round-trip time, rates.
void draw_status_line(const Scene& scene, CellBuffer& cells);

/// The keys; while chatting the line being typed; a notice, when there is one, in the row above.
void draw_key_line(const Scene& scene, const Layout& layout, CellBuffer& cells);

/// The first `rows` of the scores; yours is the last of these where it would be further down.
std::vector<const ScoreRow*> shown_rows(const std::vector<ScoreRow>& scores, int rows);

/// PLAYERS, YOU (THE ROOM for a spectator) and CHAT.
void draw_panel(const Scene& scene, const Badges& badges, const Viewport& panel, CellBuffer& cells);

}  // namespace woodlouse::client
