#include "bench/rounds/season.h"

#include <cassert>
#include <utility>

namespace woodlouse::bench {

using rules::EventKind;

Season::Season(std::shared_ptr<const map::Map> map, SeasonSettings settings)
    : settings_(std::move(settings)),
      game_(map, settings_.match),
      team_(*map, settings_.match, settings_.skill, settings_.bots) {
  for (std::uint32_t number = 0; number < settings_.bots; ++number) {
    const std::string name = server::bots::player_name(settings_.match.mode, number);
    const match::PlayerId louse = game_.join({name, state::Role::kBot});
    seqs_.push_back(std::make_unique<std::uint32_t>(1));
    team_.take(louse, number, *seqs_.back());
    records_[louse].name = name;
  }
  for (const BlindKind kind : settings_.blind) {
    const std::string name(to_text(kind));
    const match::PlayerId louse = game_.join({name, state::Role::kPlayer});
    blind_.emplace_back(kind, louse, settings_.match.tick_hz);
    records_[louse].name = name;
  }
}

void Season::play() {
  assert(settings_.ticks != 0 || settings_.rounds != 0);
  while ((settings_.ticks == 0 || game_.tick() < settings_.ticks) &&
         (settings_.rounds == 0 || results_.size() < settings_.rounds)) {
    team_.steer(game_);
    for (BlindPlayer& player : blind_) player.steer(game_);
    note(game_.advance());
  }
}

void Season::note(const match::StepRecord& step) {
  for (const match::RosterChange& change : step.roster) {
    if (change.action == match::RosterAction::kRespawn) ++records_[change.player].respawns;
  }
  for (const rules::Event& event : step.events) note(event);
  note_stuck(step.tick);
}

void Season::note(const rules::Event& event) {
  const double tick_hz = settings_.match.tick_hz;
  const std::uint64_t tick = event.moment / rules::kMomentsPerTick;
  const double seconds = static_cast<double>(event.values[event.kind == EventKind::kRun ? 0 : 1]) /
                         static_cast<double>(rules::kMomentsPerTick) / tick_hz;
  const auto better = [](double& best, double one) { best = best == 0.0 || one < best ? one : best; };
  if (event.kind == EventKind::kRound) {
    const bool is_over = event.values[1] == static_cast<std::int64_t>(rules::Phase::kPodium);
    if (is_over) end_round(static_cast<std::uint32_t>(event.values[0]));
    return;
  }
  if (event.louse == 0) return;
  Record& record = records_[event.louse];
  switch (event.kind) {
    case EventKind::kLap:
      ++record.laps;
      record.laps_s += seconds;
      better(record.best_lap_s, seconds);
      break;
    case EventKind::kRun:
      ++record.runs;
      better(record.best_run_s, seconds);
      if (event.values[2] != 0) better(record.best_from_rest_s, seconds);
      break;
    case EventKind::kBump:
      records_[static_cast<match::PlayerId>(event.values[0])].since = tick;
      break;
    case EventKind::kGate:
    case EventKind::kCrumb:
    case EventKind::kHolds:
    case EventKind::kReturned:
      break;
    default:
      return;
  }
  record.since = tick;
}

void Season::note_stuck(std::uint64_t tick) {
  for (auto& [louse, record] : records_) {
    if (tick < record.since + kStuckAfter * settings_.match.tick_hz) continue;
    ++record.stuck;
    record.since = tick;
  }
}

void Season::end_round(std::uint32_t number) {
  RoundResult result{number, {}, 0, 0};
  for (const rules::TableRow& row : game_.rules()->table()) {
    if (row.score == 0) continue;
    Record& record = records_[row.louse];
    if (settings_.match.mode != state::Mode::kRace) record.points += static_cast<std::uint64_t>(row.score);
    if (++result.finishers > 1) continue;
    result.winner = record.name;
    result.score = row.score;
    ++record.wins;
  }
  results_.push_back(std::move(result));
}

}  // namespace woodlouse::bench
