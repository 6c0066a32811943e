// What the rules of play show, read back from frames and events.
#pragma once

#include <vector>

#include "shared/protocol/field_reader.h"
#include "shared/protocol/game.h"
#include "shared/protocol/messages.h"

namespace woodlouse::protocol {

/// Of a key (REQUIRED whole there) or a delta.
Game read_game(FieldReader& game, bool is_whole);
/// The member `phase`.
void read_phase(FieldReader& reader, GamePhase& out);
/// The member `table`.
std::vector<GameTableRow> read_table(FieldReader& reader);
/// What an event of the rules, or of the boards, carries.
void read_ruling(FieldReader& reader, Event& event);

}  // namespace woodlouse::protocol
