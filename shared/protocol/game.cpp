#include "shared/protocol/game.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace woodlouse::protocol {
namespace {

constexpr std::array<std::string_view, 4> kPhases = {"gather", "countdown", "play", "podium"};

const GameCrumb* find(const std::vector<GameCrumb>& crumbs, std::uint32_t slot) {
  const auto at = std::find_if(crumbs.begin(), crumbs.end(),
                               [slot](const GameCrumb& crumb) { return crumb.slot == slot; });
  return at != crumbs.end() ? &*at : nullptr;
}

template <typename T>
std::optional<T> if_other(const std::optional<T>& key, const std::optional<T>& now) {
  return key == now ? std::nullopt : now;
}

}  // namespace

std::string_view to_text(GamePhase phase) { return kPhases[static_cast<std::size_t>(phase)]; }

std::optional<GamePhase> game_phase_from_text(std::string_view text) {
  for (std::size_t k = 0; k < kPhases.size(); ++k) {
    if (kPhases[k] == text) return static_cast<GamePhase>(k);
  }
  return std::nullopt;
}

Game difference(const Game& key, const Game& now) {
  Game delta;
  delta.phase = if_other(key.phase, now.phase);
  delta.round = if_other(key.round, now.round);
  delta.until = if_other(key.until, now.until);
  delta.hill = if_other(key.hill, now.hill);
  delta.table = if_other(key.table, now.table);
  for (const GameCrumb& crumb : now.crumbs) {
    const GameCrumb* known = find(key.crumbs, crumb.slot);
    if (known == nullptr || *known != crumb) delta.crumbs.push_back(crumb);
  }
  return delta;
}

void apply(Game& key, const Game& delta) {
  if (delta.phase) key.phase = delta.phase;
  if (delta.round) key.round = delta.round;
  if (delta.until) key.until = delta.until;
  if (delta.hill) key.hill = delta.hill;
  if (delta.table) key.table = delta.table;
  for (const GameCrumb& crumb : delta.crumbs) {
    const auto at =
        std::lower_bound(key.crumbs.begin(), key.crumbs.end(), crumb.slot,
                         [](const GameCrumb& known, std::uint32_t slot) { return known.slot < slot; });
    if (at != key.crumbs.end() && at->slot == crumb.slot) {
      *at = crumb;
    } else {
      key.crumbs.insert(at, crumb);
    }
  }
}

void append_game(json::ObjectText& text, const Game& game) {
  if (game.phase) text.text("phase", to_text(*game.phase));
  if (game.round) text.integer("round", *game.round);
  if (game.until) text.integer("until", *game.until);
  if (!game.crumbs.empty()) {
    text.array("crumbs", game.crumbs, [](std::string& out, const GameCrumb& crumb) {
      json::append_integer(out += '[', crumb.slot);
      json::append_double(out += ',', crumb.position.x);
      json::append_double(out += ',', crumb.position.y);
      json::append_integer(out += ',', crumb.value);
      out += ']';
    });
  }
  if (game.hill) {
    text.integer("place", game.hill->place).integer("holder", game.hill->holder);
    text.boolean("contested", game.hill->is_contested).integer("moves_at", game.hill->moves_at);
  }
  if (game.table) append_table(text, *game.table);
}

void append_table(json::ObjectText& text, const std::vector<GameTableRow>& table) {
  assert(table.size() <= kMaxTableRows);
  text.array("table", table, [](std::string& out, const GameTableRow& row) {
    json::append_integer(out += '[', row.id);
    json::append_integer(out += ',', row.score);
    out += ']';
  });
}

}  // namespace woodlouse::protocol
