// What the rules of play say, as the wire has it.
#pragma once

#include <vector>

#include "shared/protocol/game.h"
#include "shared/rules/rules.h"

namespace woodlouse::follow {

protocol::GamePhase shown_phase(rules::Phase phase);
/// The best, first first.
std::vector<protocol::GameTableRow> shown_table(const rules::Rules& rules);
/// Whole.
protocol::Game shown_game(const rules::Rules& rules);

}  // namespace woodlouse::follow
