// A match as the page is told of it.
#pragma once

#include <optional>

#include "shared/json/object_text.h"
#include "shared/match/match.h"
#include "shared/replay/rerun.h"

namespace woodlouse::web {

/// Answers with what its rules show, as a frame's `game`; null where there are none, or there is no match.
void answer_game(const match::Match* match);
/// Answers with who plays: [{"id", "name", "role"}, ...], by id; none where there is no match.
void answer_players(const match::Match* match);
/// Answers with how those who play by rules stand: [{"id", "score", "gate", "lap", "lap_start", "best_lap"},
/// ...], as the wire's columns.
void answer_standings(const match::Match* match);
/// The member `difference`: null, or {"tick", "what", "detail"}.
void add_difference(json::ObjectText& text, const std::optional<replay::Difference>& difference);

}  // namespace woodlouse::web
