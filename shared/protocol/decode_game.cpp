#include "shared/protocol/decode_game.h"

namespace woodlouse::protocol {
namespace {

constexpr std::size_t kMaxCrumbs = 1024;  ///< more than any map may have

bool is_integer(json::Value value, std::int64_t low, std::int64_t high) {
  return json::integer_of(value, low, high).has_value();
}

void read_crumbs(FieldReader& reader, std::vector<GameCrumb>& crumbs) {
  constexpr std::string_view kWants = "[slot, x, y, value], by ascending slot";
  reader.array(
      "crumbs", "an array of crumbs",
      [&](json::Value element, std::size_t index) {
        const std::vector<json::Value> cells = element.children();
        const bool fits = element.kind() == json::Kind::kArray && cells.size() == 4 && index < kMaxCrumbs &&
                          is_integer(cells[0], 0, 0xffff'ffff) && cells[1].is_number() &&
                          cells[2].is_number() && is_integer(cells[3], 0, 0xffff'ffff);
        if (!fits) return reader.refuse("crumbs", index, element, kWants);
        const GameCrumb crumb{static_cast<std::uint32_t>(*cells[0].integer()),
                              {cells[1].number(), cells[2].number()},
                              static_cast<std::uint32_t>(*cells[3].integer())};
        if (!crumbs.empty() && crumbs.back().slot >= crumb.slot)
          return reader.refuse("crumbs", index, element, kWants);
        crumbs.push_back(crumb);
      },
      Presence::kOptional);
}

}  // namespace

void read_phase(FieldReader& reader, GamePhase& out) {
  reader.choice("phase", out, R"("gather", "countdown", "play" or "podium")", game_phase_from_text);
}

std::vector<GameTableRow> read_table(FieldReader& reader) {
  std::vector<GameTableRow> table;
  reader.array("table", "an array of rows", [&](json::Value element, std::size_t index) {
    const std::vector<json::Value> cells = element.children();
    const bool fits = element.kind() == json::Kind::kArray && cells.size() == 2 && index < kMaxTableRows &&
                      is_integer(cells[0], 1, 0xffff'ffff) && is_integer(cells[1], -kMaxInteger, kMaxInteger);
    if (!fits) return reader.refuse("table", index, element, "[id, score]");
    table.push_back({static_cast<std::uint32_t>(*cells[0].integer()), *cells[1].integer()});
  });
  return table;
}

Game read_game(FieldReader& reader, bool is_whole) {
  Game game;
  const auto has = [&](std::string_view name) {
    return reader.field(name, "a value", Presence::kOptional).has_value();
  };
  if (is_whole || has("phase")) read_phase(reader, game.phase.emplace());
  if (is_whole || has("round")) reader.integer("round", game.round.emplace(), kAnyUint32);
  if (is_whole || has("until")) reader.integer("until", game.until.emplace(), kAnyTick);
  read_crumbs(reader, game.crumbs);
  if (has("place")) {
    GameHill& hill = game.hill.emplace();
    reader.integer("place", hill.place, kAnyUint32);
    reader.integer("holder", hill.holder, kAnyUint32);
    reader.boolean("contested", hill.is_contested);
    reader.integer("moves_at", hill.moves_at, kAnyTick);
  }
  if (is_whole || has("table")) game.table = read_table(reader);
  return game;
}

void read_ruling(FieldReader& reader, Event& event) {
  reader.integer("moment", event.moment, kAnyTick);
  const std::span<const std::string_view> names = value_names(event.kind);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto value = reader.field(names[k], "a whole number or null", Presence::kRequired);
    if (!value || value->kind() == json::Kind::kNull) continue;
    std::int64_t number = 0;
    reader.integer(names[k], number, kAnyInteger);
    event.values[k] = number;
  }
  if (event.kind != EventKind::kRound) return;
  read_phase(reader, event.phase);
  event.table = read_table(reader);
}

}  // namespace woodlouse::protocol
