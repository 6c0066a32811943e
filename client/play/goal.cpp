#include "client/play/goal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/drawing/formatted.h"
#include "client/play/shortest_way.h"
#include "shared/core/joined.h"

namespace woodlouse::client {
namespace {

constexpr double kMoments = 65536.0;  ///< of a tick

std::string name_of(const Roster& roster, std::uint32_t id) {
  const Resident* resident = roster.find(id);
  return resident != nullptr ? resident->name : core::joined({"#", std::to_string(id)});
}

std::string way_to(const GoalFacts& facts, core::Vec2 place) {
  if (facts.you == nullptr || facts.map == nullptr) return {};
  const Ways ways(facts.map->terrain->domain(), facts.map->definition.physics.edges);
  const core::Vec2 way = ways.beside(facts.you->position, place) - facts.you->position;
  return formatted("%s %.0f m", compass(way).c_str(), std::hypot(way.x, way.y));
}

std::string seconds_left(const GoalFacts& facts) {
  const double ticks = static_cast<double>(facts.game.until.value_or(0)) - facts.tick;
  const auto seconds = static_cast<long>(std::ceil(std::max(0.0, ticks) / facts.welcome.tick_hz));
  return formatted("%ld:%02ld", seconds / 60, seconds % 60);
}

std::string score_text(const GoalFacts& facts, std::int64_t score) {
  if (facts.welcome.mode == "race") return score == 0 ? "-" : span_text(score, facts.welcome.tick_hz);
  if (facts.welcome.mode == "hill")
    return formatted("%.1f s", static_cast<double>(score) / facts.welcome.tick_hz);
  return std::to_string(score);
}

std::string table_line(const GoalFacts& facts) {
  std::string line;
  int rank = 0;
  for (const protocol::GameTableRow& row : facts.game.table.value_or(std::vector<protocol::GameTableRow>())) {
    if (++rank > 3) break;
    line += formatted("%s%d. %s %s", rank > 1 ? "  " : "", rank, name_of(facts.roster, row.id).c_str(),
                      score_text(facts, row.score).c_str());
  }
  return line;
}

std::string race_line(const GoalFacts& facts, const map::RaceMode& race) {
  const Standing& standing = facts.you->standing;
  const std::size_t gate = std::min<std::size_t>(standing.gate, race.gates.size() - 1);
  std::string line = formatted("lap %u/%u", standing.lap + 1, race.laps);
  if (standing.lap_start != 0) {
    const double moments = facts.tick * kMoments - static_cast<double>(standing.lap_start);
    line += ' ' + span_text(static_cast<std::int64_t>(std::max(0.0, moments)), facts.welcome.tick_hz);
  } else {
    line += " the clock starts at gate 0";
  }
  const map::Gate& next = race.gates[gate];
  line += formatted("  gate %zu/%zu ", gate, race.gates.size()) + way_to(facts, 0.5 * (next.a + next.b));
  if (next.in_air) line += " in the air";
  if (standing.best_lap != 0) line += "  best " + span_text(standing.best_lap, facts.welcome.tick_hz);
  return line;
}

std::string forage_line(const GoalFacts& facts) {
  std::string line = formatted("score %ld", static_cast<long>(facts.you->standing.score));
  const Ways ways(facts.map->terrain->domain(), facts.map->definition.physics.edges);
  const protocol::GameCrumb* best = nullptr;
  double shortest = 0.0;
  for (const protocol::GameCrumb& crumb : facts.game.crumbs) {
    if (crumb.value == 0) continue;
    const core::Vec2 way = ways.way(facts.you->position, crumb.position);
    const double distance = std::hypot(way.x, way.y);
    if (best != nullptr &&
        (crumb.value < best->value || (crumb.value == best->value && distance >= shortest)))
      continue;
    best = &crumb;
    shortest = distance;
  }
  if (best != nullptr) line += formatted("  worth %u: ", best->value) + way_to(facts, best->position);
  return line;
}

std::string hill_line(const GoalFacts& facts, const map::HillMode& hill) {
  std::string line =
      facts.you != nullptr ? "held " + score_text(facts, facts.you->standing.score) : "you are out";
  if (!facts.game.hill) return line;
  const protocol::GameHill& shown = *facts.game.hill;
  if (shown.place < hill.places.size()) line += "  place " + way_to(facts, hill.places[shown.place].at);
  if (shown.is_contested) return line + "  contested";
  return line + (shown.holder == 0 ? "  free" : "  held by " + name_of(facts.roster, shown.holder));
}

/// What you are to do now; empty for who only looks on.
std::string aim_line(const GoalFacts& facts) {
  if (facts.map == nullptr || facts.welcome.id == 0) return {};
  const map::Modes& modes = facts.map->definition.modes;
  if (facts.welcome.mode == "hill" && modes.hill) return hill_line(facts, *modes.hill);
  if (facts.you == nullptr) return {};
  if (facts.welcome.mode == "race" && modes.race && !modes.race->gates.empty())
    return race_line(facts, *modes.race);
  if (facts.welcome.mode == "forage") return forage_line(facts);
  return {};
}

}  // namespace

std::string compass(core::Vec2 way) {
  constexpr const char* kNames[] = {"E", "NE", "N", "NW", "W", "SW", "S", "SE"};
  const double eighths = std::atan2(way.y, way.x) * (4.0 / std::numbers::pi);
  return kNames[(static_cast<long>(std::lround(eighths)) + 8) % 8];
}

std::string span_text(std::int64_t moments, std::uint32_t tick_hz) {
  const auto ms = static_cast<std::int64_t>(static_cast<double>(moments) / kMoments / tick_hz * 1e3);
  return formatted("%ld:%02ld.%03ld", static_cast<long>(ms / 60000), static_cast<long>(ms / 1000 % 60),
                   static_cast<long>(ms % 1000));
}

std::vector<std::string> goal_lines(const GoalFacts& facts) {
  if (!facts.game.phase) return {};
  std::string first = facts.welcome.mode;
  switch (*facts.game.phase) {
    case protocol::GamePhase::kGather:
      return {first + "  nobody plays"};
    case protocol::GamePhase::kCountdown:
      first += formatted("  round %u begins in ", facts.game.round.value_or(0)) + seconds_left(facts);
      break;
    case protocol::GamePhase::kPlay:
      first += formatted("  round %u  ", facts.game.round.value_or(0)) + seconds_left(facts);
      break;
    case protocol::GamePhase::kPodium:
      return {first + "  the round is over  " + seconds_left(facts), table_line(facts)};
  }
  const std::string aim = aim_line(facts);
  return aim.empty() ? std::vector<std::string>{first + "  " + table_line(facts)}
                     : std::vector<std::string>{first, aim};
}

std::string describe_ruling(const protocol::Event& event, std::uint32_t you, std::uint32_t tick_hz) {
  using protocol::EventKind;
  const auto value = [&event](std::size_t k) { return event.values[k].value_or(0); };
  const bool is_you = event.id != 0 && event.id == you;
  switch (event.kind) {
    case EventKind::kGate:
      if (!is_you) return {};
      return formatted("gate %ld %s", static_cast<long>(value(0)), span_text(value(2), tick_hz).c_str()) +
             (event.values[3] ? formatted(" %+.2f s", static_cast<double>(value(3)) / kMoments / tick_hz)
                              : "");
    case EventKind::kLapDone:
      return is_you ? "lap " + span_text(value(1), tick_hz) + (value(2) != 0 ? ", your best" : "")
                    : std::string();
    case EventKind::kRun:
      return formatted("%s ran %s, #%ld", event.name.c_str(), span_text(value(0), tick_hz).c_str(),
                       static_cast<long>(value(1)));
    case EventKind::kRecord:
      return formatted("%s drove a record: %s", event.name.c_str(), span_text(value(0), tick_hz).c_str());
    case EventKind::kHarvest:
      return "harvest: crumbs count twice";
    case EventKind::kHolds:
      return event.id == 0 ? "nobody holds the place" : event.name + " holds the place";
    case EventKind::kMoving:
      return "the place will move";
    case EventKind::kFell:
      return event.name + " fell";
    case EventKind::kRound:
      if (event.phase == protocol::GamePhase::kPlay)
        return formatted("round %ld begins", static_cast<long>(value(0)));
      if (event.phase == protocol::GamePhase::kPodium)
        return formatted("round %ld is over", static_cast<long>(value(0)));
      return {};
    default:
      return {};
  }
}

}  // namespace woodlouse::client
