#include "shared/follow/shown_game.h"

namespace woodlouse::follow {

protocol::GamePhase shown_phase(rules::Phase phase) {
  static_assert(static_cast<int>(rules::Phase::kPodium) == static_cast<int>(protocol::GamePhase::kPodium));
  return static_cast<protocol::GamePhase>(phase);
}

std::vector<protocol::GameTableRow> shown_table(const rules::Rules& rules) {
  std::vector<protocol::GameTableRow> rows;
  for (const rules::TableRow& row : rules.table()) {
    if (rows.size() == protocol::kMaxTableRows) break;
    rows.push_back({row.louse, row.score});
  }
  return rows;
}

protocol::Game shown_game(const rules::Rules& rules) {
  protocol::Game game;
  const rules::Round& round = rules.round();
  game.phase = shown_phase(round.phase);
  game.round = round.number;
  game.until = round.until;
  for (const rules::ShownCrumb& crumb : rules.shown_crumbs())
    game.crumbs.push_back({crumb.slot, crumb.position, crumb.value});
  if (const auto hill = rules.shown_hill())
    game.hill = {hill->place, hill->holder, hill->is_contested, hill->moves_at};
  game.table = shown_table(rules);
  return game;
}

}  // namespace woodlouse::follow
