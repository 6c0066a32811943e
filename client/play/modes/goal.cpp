#include "client/play/modes/goal.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "client/drawing/formatted.h"
#include "client/play/shortest_way.h"
#include "shared/core/joined.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/rules/climb.h"

namespace woodlouse::client {
namespace {

constexpr double kMoments = 65536.0;  ///< of a tick

core::Vec2 seen_from_you(const GoalFacts& facts, core::Vec2 place) {
  const map::Map& map = *facts.sight.map;
  return Ways(map.terrain->domain(), map.definition.physics.edges).beside(facts.you->position, place);
}

double seconds_until(const GoalFacts& facts, std::uint64_t tick) {
  return std::max(0.0, static_cast<double>(tick) - facts.sight.ruling.tick) / facts.sight.ruling.tick_hz;
}

std::string seconds_left(const GoalFacts& facts) {
  const auto seconds =
      static_cast<long>(std::ceil(seconds_until(facts, facts.sight.ruling.game->until.value_or(0))));
  return formatted("%ld:%02ld", seconds / 60, seconds % 60);
}

/// The next medal that the best run has not yet, and its time.
struct Medal {
  std::string_view name;
  std::uint64_t ms = 0;
};
std::array<Medal, 4> medals(std::uint64_t author_ms) {
  const auto times = [author_ms](std::uint64_t hundredths) { return (author_ms * hundredths + 99) / 100; };
  return {{{"AUTHOR", author_ms}, {"GOLD", times(106)}, {"SILVER", times(120)}, {"BRONZE", times(150)}}};
}

double milliseconds(std::int64_t moments, std::uint32_t tick_hz) {
  return static_cast<double>(moments) / kMoments / tick_hz * 1e3;
}

std::string medal_to_win(std::uint64_t author_ms, std::int64_t best, std::uint32_t tick_hz) {
  if (author_ms == 0) return {};
  const auto all = medals(author_ms);
  for (auto medal = all.rbegin(); medal != all.rend(); ++medal) {
    if (best != 0 && milliseconds(best, tick_hz) <= static_cast<double>(medal->ms)) continue;
    std::string name(medal->name);
    for (char& c : name) c = static_cast<char>(c + ('a' - 'A'));
    return name + formatted(" %lu:%02lu.%02lu", static_cast<unsigned long>(medal->ms / 60000),
                            static_cast<unsigned long>(medal->ms / 1000 % 60),
                            static_cast<unsigned long>(medal->ms / 10 % 100));
  }
  return "all medals won";
}

void race_line(const GoalFacts& facts, const map::RaceMode& race, GoalLine& line) {
  const Ruling& ruling = facts.sight.ruling;
  const Standing& standing = facts.you->standing;
  line.push_back({formatted("lap %u/%u ", std::min(standing.lap + 1, race.laps), race.laps), Tone::kUsual});
  if (standing.lap_start != 0) {
    const std::int64_t begin =
        facts.run != nullptr && facts.run->run_start() != 0 ? facts.run->run_start() : standing.lap_start;
    const double moments = ruling.tick * kMoments - static_cast<double>(begin);
    line.push_back({"run ", Tone::kUsual, true});  // of all laps
    line.push_back(
        {span_text(static_cast<std::int64_t>(std::max(0.0, moments)), ruling.tick_hz), Tone::kStrong});
  } else {
    line.push_back({"starts at S", Tone::kUsual});
  }
  if (facts.rank > 0)
    line.push_back({formatted("  #%d/%zu", facts.rank, facts.sight.lice.size()), Tone::kUsual, true});
  if (const std::string medal = medal_to_win(ruling.author_ms, standing.score, ruling.tick_hz);
      !medal.empty())
    line.push_back({"  " + medal, Tone::kGoal});
  else if (standing.score != 0)
    line.push_back({"  best " + span_text(standing.score, ruling.tick_hz), Tone::kUsual});
}

void forage_line(const GoalFacts& facts, const map::ForageMode&, GoalLine& line) {
  const Ruling& ruling = facts.sight.ruling;
  line.push_back({formatted("score %ld", static_cast<long>(facts.you->standing.score)), Tone::kStrong});
  if (facts.rank > 0)
    line.push_back({formatted("  #%d/%zu", facts.rank, facts.sight.lice.size()), Tone::kUsual, true});
  if (facts.run == nullptr) return;
  const std::int64_t chain = facts.run->chain(ruling.tick, ruling.tick_hz);
  if (chain == 0) return;
  constexpr int kBar = 8;
  const int full = static_cast<int>(std::ceil(facts.run->chain_left(ruling.tick, ruling.tick_hz) * kBar));
  line.push_back(
      {formatted("  x%ld ", static_cast<long>(std::min<std::int64_t>(3, chain + 1))), Tone::kGoal});
  line.push_back({"[" + std::string(static_cast<std::size_t>(full), '=') +
                      std::string(static_cast<std::size_t>(kBar - full), ' ') + "]",
                  Tone::kGoal});
}

void hill_line(const GoalFacts& facts, const map::HillMode& hill, GoalLine& line) {
  const Ruling& ruling = facts.sight.ruling;
  line.push_back(facts.you != nullptr
                     ? GoalSpan{"held " + score_text(ruling.mode, facts.you->standing.score, ruling.tick_hz),
                                Tone::kStrong}
                     : GoalSpan{"out: back at a spawn soon", Tone::kBad});
  if (facts.you != nullptr) line.push_back({formatted(" of %u s", hill.hold_s), Tone::kUsual, true});
  if (!ruling.game->hill) return;
  const protocol::GameHill& shown = *ruling.game->hill;
  if (shown.is_contested)
    line.push_back({"  CONTESTED", Tone::kGoal});
  else if (shown.holder == 0)
    line.push_back({"  free", Tone::kUsual});
  else if (shown.holder == facts.id)
    line.push_back({"  YOU HOLD IT", Tone::kGood});
  else
    line.push_back({"  " + facts.sight.name_of(shown.holder) + " holds it", Tone::kBad});
}

/// What comes behind the way on the first line.
void add_next(const GoalFacts& facts, GoalLine& line) {
  const Ruling& ruling = facts.sight.ruling;
  if (ruling.mode != state::Mode::kHill || !ruling.game->hill || ruling.game->hill->moves_at == 0) return;
  const auto seconds = static_cast<long>(std::ceil(seconds_until(facts, ruling.game->hill->moves_at)));
  line.push_back({formatted("  moves in %lds", seconds), seconds <= 5 ? Tone::kGoal : Tone::kDim});
}

/// Whether the next metres straight to that place are steeper than a push climbs from rest.
bool needs_run_up(const GoalFacts& facts, core::Vec2 place) {
  constexpr double kLooked = 10.0;  ///< [m]
  constexpr int kSamples = 20;
  const map::Map& map = *facts.sight.map;
  const core::Vec2 here = facts.you->position;
  const core::Vec2 way = place - here;
  const double length = std::hypot(way.x, way.y);
  if (!(length > 0.0)) return false;
  const core::Vec2 direction = (1.0 / length) * way;
  const double climbs = rules::climbable_slope(map.definition.physics);
  const terrain::Rectangle& domain = map.terrain->domain();
  for (int k = 0; k <= kSamples; ++k) {
    const core::Vec2 at = here + (std::min(kLooked, length) * k / kSamples) * direction;
    if (at.x < domain.x_min || at.x > domain.x_max || at.y < domain.y_min || at.y > domain.y_max) break;
    const terrain::SurfaceSample ground = map.terrain->sample(at.x, at.y);
    if (ground.zx * direction.x + ground.zy * direction.y > climbs) return true;
  }
  return false;
}

/// "gate 3: NE 27 m": what is aimed at, and from where.
void add_aim(const GoalFacts& facts, GoalLine& line) {
  const Ruling& ruling = facts.sight.ruling;
  const auto place = goal_of(facts);
  if (!place) return;
  std::string what;
  bool is_flown = false;
  switch (ruling.mode) {
    case state::Mode::kRace: {
      const map::RaceMode& race = *facts.sight.map->definition.modes.race;
      const std::size_t gate = std::min<std::size_t>(facts.you->standing.gate, race.gates.size() - 1);
      what = gate_name(static_cast<std::int64_t>(gate)) + ":";  // "gate S S" would be read as one
      is_flown = race.gates[gate].in_air;
      break;
    }
    case state::Mode::kForage:
      what = dearest_crumb(facts)->value > 1 ? "crumb worth 3:" : "crumb:";
      break;
    case state::Mode::kHill:
      line.push_back({"  place", Tone::kGoal, true});
      break;
    case state::Mode::kRoam:
      break;
  }
  line.push_back({(what.empty() ? "" : "  " + what) + " " +
                      way_text(*place - facts.you->position, facts.up, facts.winds),
                  Tone::kGoal});
  if (is_flown) line.push_back({", fly through", Tone::kGoal, true});
  if (facts.is_own && needs_run_up(facts, *place)) line.push_back({", needs a run-up", Tone::kGoal, true});
  if (!facts.is_own) line.push_back({" from " + facts.sight.name_of(facts.id), Tone::kDim, true});
}

/// What you are to do now; empty for nobody.
GoalLine own_line(const GoalFacts& facts) {
  GoalLine line;
  if (facts.sight.map == nullptr || facts.id == 0) return line;
  if (!facts.is_own) line.push_back({facts.sight.name_of(facts.id) + ": ", Tone::kUsual});
  const map::Modes& modes = facts.sight.map->definition.modes;
  const state::Mode mode = facts.sight.ruling.mode;
  if (mode == state::Mode::kHill && modes.hill) {
    hill_line(facts, *modes.hill, line);
  } else if (facts.you == nullptr) {
    return {};
  } else if (mode == state::Mode::kRace && modes.race && !modes.race->gates.empty()) {
    race_line(facts, *modes.race, line);
  } else if (mode == state::Mode::kForage && modes.forage) {
    forage_line(facts, *modes.forage, line);
  }
  return line;
}

/// In a round's last part crumbs count twice (rules/forage.h).
bool is_harvest(const GoalFacts& facts) {
  constexpr double kHarvestSeconds = 30.0;
  const Ruling& ruling = facts.sight.ruling;
  return ruling.mode == state::Mode::kForage && ruling.game->phase == protocol::GamePhase::kPlay &&
         seconds_until(facts, ruling.game->until.value_or(0)) <= kHarvestSeconds;
}

}  // namespace

const protocol::GameCrumb* dearest_crumb(const GoalFacts& facts) {
  const protocol::GameCrumb* best = nullptr;
  double shortest = 0.0;
  for (const protocol::GameCrumb& crumb : facts.sight.ruling.game->crumbs) {
    if (crumb.value == 0) continue;
    const core::Vec2 way = seen_from_you(facts, crumb.position) - facts.you->position;
    const double distance = std::hypot(way.x, way.y);
    if (best != nullptr &&
        (crumb.value < best->value || (crumb.value == best->value && distance >= shortest)))
      continue;
    best = &crumb;
    shortest = distance;
  }
  return best;
}

std::optional<core::Vec2> goal_of(const GoalFacts& facts) {
  const Ruling& ruling = facts.sight.ruling;
  if (ruling.game == nullptr || facts.you == nullptr || facts.sight.map == nullptr) return std::nullopt;
  if (ruling.game->phase != protocol::GamePhase::kPlay &&
      ruling.game->phase != protocol::GamePhase::kCountdown)
    return std::nullopt;
  const map::Modes& modes = facts.sight.map->definition.modes;
  switch (ruling.mode) {
    case state::Mode::kRace: {
      if (!modes.race || modes.race->gates.empty()) return std::nullopt;
      const auto& gates = modes.race->gates;
      const map::Gate& gate = gates[std::min<std::size_t>(facts.you->standing.gate, gates.size() - 1)];
      return seen_from_you(facts, 0.5 * (gate.a + gate.b));
    }
    case state::Mode::kForage: {
      const protocol::GameCrumb* crumb = modes.forage ? dearest_crumb(facts) : nullptr;
      return crumb == nullptr ? std::nullopt : std::optional(seen_from_you(facts, crumb->position));
    }
    case state::Mode::kHill: {
      if (!modes.hill || !ruling.game->hill || ruling.game->hill->place >= modes.hill->places.size())
        return std::nullopt;
      return seen_from_you(facts, modes.hill->places[ruling.game->hill->place].at);
    }
    case state::Mode::kRoam:
      break;
  }
  return std::nullopt;
}

std::string score_text(state::Mode mode, std::int64_t score, std::uint32_t tick_hz) {
  if (mode == state::Mode::kRace) return score == 0 ? "--" : span_text(score, tick_hz);
  if (mode == state::Mode::kHill) return formatted("%.1f s", static_cast<double>(score) / tick_hz);
  return std::to_string(score);
}

std::uint64_t author_ms_of(const std::string& rules) {
  constexpr std::int64_t kLongest = 86'400'000;
  const auto document = json::parse(rules, {8, 10'000});
  const auto stated = document ? document->root().find("author_ms") : std::nullopt;
  const auto ms = stated ? json::integer_of(*stated, 0, kLongest) : std::nullopt;
  return static_cast<std::uint64_t>(ms.value_or(0));
}

std::string medal_of(std::uint64_t author_ms, std::int64_t moments, std::uint32_t tick_hz) {
  assert(tick_hz > 0);
  if (author_ms == 0 || moments <= 0) return {};
  for (const Medal& medal : medals(author_ms))
    if (milliseconds(moments, tick_hz) <= static_cast<double>(medal.ms)) return std::string(medal.name);
  return {};
}

std::vector<GoalLine> goal_lines(const GoalFacts& facts) {
  const Ruling& ruling = facts.sight.ruling;
  if (ruling.game == nullptr || !ruling.game->phase) return {};
  const std::string mode(state::to_text(ruling.mode));
  const unsigned round = ruling.game->round.value_or(0);
  GoalLine first{{mode, Tone::kStrong}};
  switch (*ruling.game->phase) {
    case protocol::GamePhase::kGather:
      first.push_back({"  nobody plays", Tone::kDim});
      return {first};
    case protocol::GamePhase::kCountdown:
      first.push_back({formatted("  round %u begins in ", round) + seconds_left(facts), Tone::kGoal});
      break;
    case protocol::GamePhase::kPlay:
      // A hill's round is long, and where the line is cut off what its place does matters more.
      if (ruling.mode != state::Mode::kHill) {
        first.push_back({"  " + seconds_left(facts), Tone::kStrong});
        first.push_back({" left", Tone::kStrong, true});
      }
      if (is_harvest(facts)) first.push_back({"  HARVEST x2", Tone::kGoal});
      break;
    case protocol::GamePhase::kPodium:
      first.push_back({"  next round in " + seconds_left(facts), Tone::kGoal});
      first.push_back({formatted("  round %u is over", round), Tone::kDim, true});
      return {first};
  }
  add_aim(facts, first);
  add_next(facts, first);
  if (ruling.mode == state::Mode::kHill && ruling.game->phase == protocol::GamePhase::kPlay) {
    first.push_back({"  " + seconds_left(facts), Tone::kDim, true});
    first.push_back({" left", Tone::kDim, true});
  }
  const GoalLine own = own_line(facts);
  return own.empty() ? std::vector<GoalLine>{first} : std::vector<GoalLine>{first, own};
}

std::string gate_name(std::int64_t gate) { return gate == 0 ? "gate S" : "gate " + std::to_string(gate); }

std::string span_text(std::int64_t moments, std::uint32_t tick_hz) {
  assert(tick_hz > 0);
  if (moments < 0) return "-" + span_text(moments == INT64_MIN ? INT64_MAX : -moments, tick_hz);
  const auto ms = static_cast<std::int64_t>(static_cast<double>(moments) / kMoments / tick_hz * 1e3);
  return formatted("%ld:%02ld.%03ld", static_cast<long>(ms / 60000), static_cast<long>(ms / 1000 % 60),
                   static_cast<long>(ms % 1000));
}

}  // namespace woodlouse::client
