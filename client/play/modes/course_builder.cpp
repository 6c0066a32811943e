#include "client/play/modes/course_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "client/drawing/formatted.h"
#include "client/play/scene_builder.h"
#include "shared/rules/climb.h"

namespace woodlouse::client {
namespace {

void add_gates(const GoalFacts& facts, const map::RaceMode& race, Course& course) {
  for (std::size_t k = 0; k < race.gates.size(); ++k) {
    const map::Gate& gate = race.gates[k];
    GateMark mark{gate.a, gate.b, k == 0 ? "S" : std::to_string(k), false, gate.in_air};
    mark.is_next = facts.you != nullptr && facts.you->standing.gate == k;
    course.gates.push_back(std::move(mark));
  }
}

void add_rings(const map::HillMode& hill, const protocol::GameHill& shown, double seconds_left,
               Course& course) {
  if (shown.place >= hill.places.size()) return;
  const map::HillPlace& place = hill.places[shown.place];
  RingMark ring{place.at, place.radius, RingMark::State::kFree, shown.holder};
  if (shown.holder != 0) ring.state = RingMark::State::kHeld;
  if (shown.is_contested) ring.state = RingMark::State::kContested;
  course.rings.push_back(ring);
  constexpr double kToldBefore = 15.0;  // [s]
  if (shown.moves_at == 0 || hill.places.size() < 2 || seconds_left > kToldBefore) return;
  const map::HillPlace& next = hill.places[(shown.place + 1) % hill.places.size()];
  course.rings.push_back({next.at, next.radius, RingMark::State::kComing, 0});
}

void add_podium(const GoalFacts& facts, Course& course) {
  const Ruling& ruling = facts.sight.ruling;
  if (!ruling.game->table) return;
  for (const protocol::GameTableRow& row : *ruling.game->table) {
    if (course.podium.size() == 3) break;
    if (row.score == 0) continue;  // was there, and did nothing that counts
    PodiumStep step{row.id, facts.sight.name_of(row.id), facts.is_own && row.id == facts.id,
                    score_text(ruling.mode, row.score, ruling.tick_hz), ""};
    if (ruling.mode == state::Mode::kRace) step.medal = medal_of(ruling.author_ms, row.score, ruling.tick_hz);
    course.podium.push_back(std::move(step));
  }
  if (facts.you == nullptr || !facts.is_own) return;
  course.podium_note = facts.you->standing.score != 0
                           ? "you: " + score_text(ruling.mode, facts.you->standing.score, ruling.tick_hz) +
                                 (facts.rank > 0 ? formatted(", #%d", facts.rank) : "")
                           : "nothing of yours counted this time";
  if (ruling.mode != state::Mode::kRace) return;
  const std::string medal = medal_of(ruling.author_ms, facts.you->standing.score, ruling.tick_hz);
  if (!medal.empty()) course.podium_note += "  " + medal;
}

ScoreRow row_of(const Sight& sight, std::uint32_t id, const Present& louse) {
  const terrain::SurfaceSample ground = ground_under(sight, louse.sample.position);
  ScoreRow row{id,
               louse.name,
               louse.is_bot ? LouseKind::kBot : LouseKind::kPlayer,
               louse.is_you,
               louse.sample.distance,
               speed_in_space(ground, louse.sample.velocity)};
  return row;
}

/// How far somebody is in a run: gates since its start; 0 where the clock does not run, and in other modes.
double progress(const Sight& sight, const Standing& standing) {
  if (sight.ruling.mode != state::Mode::kRace || standing.lap_start == 0 || sight.map == nullptr) return 0.0;
  const auto& race = sight.map->definition.modes.race;
  if (!race) return 0.0;
  const std::size_t gates = race->gates.size();
  const std::size_t passed = standing.gate == 0 ? gates : standing.gate;  // the last one leads to the first
  return static_cast<double>(standing.lap * gates + passed);
}

void measure(const Sight& sight, const Standing& standing, ScoreRow& row) {
  const Ruling& ruling = sight.ruling;
  const std::int64_t score = standing.score;
  row.measure = score_text(ruling.mode, score, ruling.tick_hz);
  if (score == 0 && progress(sight, standing) > 0.0)
    row.measure = formatted("lap %u/%u", standing.lap + 1, sight.map->definition.modes.race->laps);
  if (ruling.mode != state::Mode::kHill || sight.map == nullptr || !sight.map->definition.modes.hill) return;
  const double wins = static_cast<double>(sight.map->definition.modes.hill->hold_s) * ruling.tick_hz;
  row.share = std::clamp(static_cast<double>(score) / wins, 0.0, 1.0);
}

/// Who fell, and is not back yet.
ScoreRow row_of_out(const Sight& sight, const protocol::GameTableRow& out) {
  const bool is_bot = sight.is_bot && sight.is_bot(out.id);
  const bool is_you = sight.pilot != nullptr && sight.pilot->id() == out.id;
  ScoreRow row{out.id, sight.name_of(out.id), is_bot ? LouseKind::kBot : LouseKind::kPlayer, is_you, 0.0,
               0.0};
  Standing standing;
  standing.score = out.score;
  measure(sight, standing, row);
  row.measure = "out";
  return row;
}

/// Of whom only the mode's table tells.
std::vector<ScoreRow> rows_of_table(const Sight& sight) {
  std::vector<ScoreRow> rows;
  const auto add = [&](std::uint32_t id, const Standing& standing, int rank) {
    const auto louse = sight.lice.find(id);
    ScoreRow row = louse != sight.lice.end()
                       ? row_of(sight, id, louse->second)
                       : ScoreRow{id, sight.name_of(id), LouseKind::kPlayer, false, 0.0, 0.0};
    row.rank = rank;
    measure(sight, standing, row);
    rows.push_back(std::move(row));
  };
  int rank = 0;
  if (sight.ruling.game->table)
    for (const protocol::GameTableRow& row : *sight.ruling.game->table) {
      Standing standing;
      standing.score = row.score;
      add(row.id, standing, ++rank);
    }
  for (const auto& [id, louse] : sight.lice)
    if (louse.is_you &&
        std::none_of(rows.begin(), rows.end(), [own = id](const ScoreRow& r) { return r.id == own; }))
      add(id, louse.sample.standing, 0);
  return rows;
}

/// What is played, for the help.
std::vector<std::string> rules_in_words(state::Mode mode, const map::Modes& modes) {
  if (mode == state::Mode::kRace && modes.race)
    return {"race: drive through the gates in turn, S first,",
            formatted("%u laps, from gate to gate. The best run wins.", modes.race->laps)};
  if (mode == state::Mode::kForage && modes.forage)
    return {"forage: roll over crumbs; * is worth 3. One within",
            "4 s of another counts twice, the next three times."};
  if (mode == state::Mode::kHill && modes.hill)
    return {"hill: be alone in the ring to hold it; held for",
            formatted("%u s wins.", modes.hill->hold_s) +
                (modes.hill->falls ? " Bump others off, and don't fall." : " Lice bump each other away.")};
  return {};
}

}  // namespace

Course course_of(const GoalFacts& facts) {
  Course course;
  const Ruling& ruling = facts.sight.ruling;
  if (facts.sight.map != nullptr) {
    const double climbs = rules::climbable_slope(facts.sight.map->definition.physics);
    if (climbs < 10.0) course.climbs = climbs;  // beyond that nothing is too steep
  }
  if (ruling.game == nullptr || facts.sight.map == nullptr) return course;
  const map::Modes& modes = facts.sight.map->definition.modes;
  if (ruling.mode == state::Mode::kRace && modes.race) add_gates(facts, *modes.race, course);
  const protocol::GameCrumb* const wanted =
      ruling.mode == state::Mode::kForage && goal_of(facts) ? dearest_crumb(facts) : nullptr;
  for (const protocol::GameCrumb& crumb : ruling.game->crumbs)
    if (crumb.value > 0) course.crumbs.push_back({crumb.position, crumb.value, &crumb == wanted});
  if (ruling.mode == state::Mode::kHill && modes.hill && ruling.game->hill)
    add_rings(*modes.hill, *ruling.game->hill,
              (static_cast<double>(ruling.game->hill->moves_at) - ruling.tick) / ruling.tick_hz, course);
  course.lines = goal_lines(facts);
  course.rules = rules_in_words(ruling.mode, modes);
  course.target = goal_of(facts);
  course.up = facts.up;
  if (ruling.game->phase == protocol::GamePhase::kPodium) add_podium(facts, course);
  return course;
}

std::vector<ScoreRow> score_rows(const Sight& sight) {
  const bool has_rules = sight.ruling.game != nullptr;
  if (has_rules && sight.is_part) return rows_of_table(sight);
  std::map<std::uint32_t, int> in_table;  // breaks ties as the server does
  if (has_rules && sight.ruling.game->table)
    for (const protocol::GameTableRow& row : *sight.ruling.game->table)
      in_table.emplace(row.id, static_cast<int>(in_table.size()));
  struct Order {
    double score = 0.0;     ///< larger is better
    double progress = 0.0;  ///< the same, among equals
    int place = 0;
  };
  std::vector<std::pair<Order, ScoreRow>> order;
  for (const auto& [id, louse] : sight.lice) {
    ScoreRow row = row_of(sight, id, louse);
    const std::int64_t score = louse.sample.standing.score;
    Order key{louse.sample.distance, 0.0, std::numeric_limits<int>::max()};
    if (has_rules) {
      measure(sight, louse.sample.standing, row);
      key.progress = score == 0 ? progress(sight, louse.sample.standing) : 0.0;
      key.score = static_cast<double>(score);
      if (sight.ruling.mode == state::Mode::kRace)  // the shorter the better, and any better than none
        key.score = score == 0 ? -std::numeric_limits<double>::infinity() : -key.score;
      if (const auto place = in_table.find(id); place != in_table.end()) key.place = place->second;
    }
    order.emplace_back(key, std::move(row));
  }
  if (has_rules && sight.ruling.mode == state::Mode::kHill && sight.ruling.game->table)
    for (const protocol::GameTableRow& out : *sight.ruling.game->table) {
      if (sight.lice.contains(out.id)) continue;
      order.emplace_back(Order{static_cast<double>(out.score), 0.0, in_table.at(out.id)},
                         row_of_out(sight, out));
    }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::tie(b.first.score, b.first.progress, a.first.place) <
           std::tie(a.first.score, a.first.progress, b.first.place);
  });
  std::vector<ScoreRow> rows;
  for (auto& [key, row] : order) {
    rows.push_back(std::move(row));
    const bool has_rank = std::isfinite(key.score) && !sight.is_part;
    rows.back().rank = has_rank ? static_cast<int>(rows.size()) : 0;
  }
  return rows;
}

std::string measured_by(const Sight& sight) {
  if (sight.ruling.game == nullptr) return {};
  switch (sight.ruling.mode) {
    case state::Mode::kRace:
      return "best run of the round";
    case state::Mode::kForage:
      return "points";
    case state::Mode::kHill:
      return "seconds that the place was held";
    case state::Mode::kRoam:
      break;
  }
  return {};
}

}  // namespace woodlouse::client
