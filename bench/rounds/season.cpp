#include "bench/rounds/season.h"

#include <cassert>
#include <utility>

namespace woodlouse::bench {

using rules::EventKind;

Season::Season(std::shared_ptr<const map::Map> map, SeasonSettings settings)
    : settings_(std::move(settings)),
      map_(std::move(map)),
      game_(map_, settings_.match),
      team_(*map_, settings_.match, settings_.skill, settings_.bots),
      tracks_(settings_.match.tick_hz) {
  assert(!settings_.wants_ghost || settings_.match.mode == state::Mode::kRace);
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
    const match::StepRecord& step = game_.advance();
    note(step);
    if (!settings_.wants_ghost) continue;
    keep_best(step);
    send_to_spawns(step);
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

bool Season::is_hopeless(const rules::Event& gate) {
  assert(gate.kind == EventKind::kGate);
  const auto number = static_cast<std::uint64_t>(gate.values[0]);
  const auto lap = static_cast<std::uint64_t>(gate.values[1]);
  rules::Moment& start = records_[gate.louse].run_start;
  const bool starts_clock = number == 0 && gate.values[2] == 0;
  if (starts_clock) start = gate.moment;
  if (starts_clock || !best_run_) return false;
  const std::vector<rules::Moment>& best = best_run_->driven.times.gates;
  const std::uint64_t of_lap = map_->definition.modes.race->gates.size();
  const std::uint64_t index = lap * of_lap + (number == 0 ? of_lap : number);  // the first ends the lap
  assert(index < best.size());
  const auto slack = static_cast<rules::Moment>(settings_.hopeless_behind * settings_.match.tick_hz *
                                                rules::kMomentsPerTick);
  return gate.moment - start > best[index] - best.front() + slack;
}

/// Who is done begins anew, or can't be the best any more; and all do with a round: lice drive on between
/// rounds, and what they drive then did not begin at rest.
void Season::send_to_spawns(const match::StepRecord& step) {
  for (const rules::Event& event : step.events) {
    if (event.kind == EventKind::kRun || (event.kind == EventKind::kGate && is_hopeless(event)))
      game_.respawn(event.louse);
    const bool is_begun =
        event.kind == EventKind::kRound && event.values[1] == static_cast<std::int64_t>(rules::Phase::kPlay);
    if (!is_begun) continue;
    for (const auto& [louse, record] : records_) game_.respawn(louse);
  }
}

/// One that began before its round did counts gates otherwise: the re-run tells.
void Season::keep_best(const match::StepRecord& step) {
  for (match::DrivenRun& driven : tracks_.take(step)) {
    const bool is_better = !best_run_ || driven.time < best_run_->driven.time;
    if (!driven.is_kept || !is_better) continue;
    if (!match::why_not_proven(*map_, settings_.match.tick_hz, driven.ghost, driven.times).empty()) continue;
    best_run_ = {records_[driven.player].name, std::move(driven)};
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
