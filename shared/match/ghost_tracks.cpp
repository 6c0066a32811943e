#include "shared/match/ghost_tracks.h"

#include <algorithm>
#include <utility>

#include "shared/rules/round.h"

namespace woodlouse::match {

std::vector<DrivenRun>& GhostTracks::take(const StepRecord& step) {
  done_.clear();
  take_roster(step);
  take_inputs(step);
  for (const rules::Event& event : step.events) take_event(step, event);
  return done_;
}

/// Who went back to a gate has no spawn behind it any more.
void GhostTracks::take_roster(const StepRecord& step) {
  for (const RosterChange& change : step.roster) forget(change.player);
  for (const Spawned& spawned : step.spawned) {
    Track track;
    track.begin = step.tick;
    track.ghost.spawn = spawned.spawn;
    tracks_.insert_or_assign(spawned.player, std::move(track));
  }
  for (const RosterChange& change : step.roster)
    if (change.action == RosterAction::kLeave) forget(change.player);
}

void GhostTracks::take_inputs(const StepRecord& step) {
  for (const AppliedInput& input : step.inputs) {
    const auto found = tracks_.find(input.player);
    if (found == tracks_.end() || !found->second.is_kept) continue;
    Track& track = found->second;
    const std::uint64_t at = step.tick - track.begin;
    if (at >= most_ticks() || track.ghost.inputs.size() >= state::kMostGhostInputs ||
        inputs_ >= kMostInputs) {
      give_up(track);
      continue;
    }
    track.ghost.inputs.push_back({static_cast<std::uint32_t>(at), {input.kind, input.thrust}, input.ticks});
    ++inputs_;
  }
}

void GhostTracks::take_event(const StepRecord& step, const rules::Event& event) {
  if (event.kind == rules::EventKind::kRound &&
      event.values[1] == static_cast<std::int64_t>(rules::Phase::kPlay))
    play_began_ = event.moment / rules::kMomentsPerTick;
  const auto found = tracks_.find(event.louse);
  if (found == tracks_.end()) return;
  Track& track = found->second;
  if (event.kind == rules::EventKind::kGate) {
    const bool starts_clock = event.values[0] == 0 && event.values[2] == 0;
    if (starts_clock) track.gates.clear();
    track.gates.push_back(event.moment);
  }
  if (event.kind != rules::EventKind::kRun) return;
  if (event.values[2] == 1 && !track.gates.empty()) {
    const std::uint64_t ticks = step.tick + 1 - track.begin;
    if (ticks > most_ticks()) give_up(track);
    DrivenRun run;
    run.player = event.louse;
    run.ended = event.moment;
    run.time = static_cast<rules::Moment>(event.values[0]);
    run.is_kept = track.is_kept;
    if (track.is_kept) {
      for (const rules::Moment gate : track.gates)
        run.times.gates.push_back(gate - track.begin * rules::kMomentsPerTick);
      run.ghost = track.ghost;
      run.ghost.ticks = static_cast<std::uint32_t>(ticks);
      run.counted_from =
          play_began_ > track.begin ? static_cast<std::uint32_t>(play_began_ - track.begin) : 0;
    }
    done_.push_back(std::move(run));
  }
  forget(event.louse);  // what it drives on is no run from a spawn
}

void GhostTracks::forget(PlayerId player) {
  const auto found = tracks_.find(player);
  if (found == tracks_.end()) return;
  inputs_ -= found->second.ghost.inputs.size();
  tracks_.erase(found);
}

void GhostTracks::give_up(Track& track) {
  inputs_ -= track.ghost.inputs.size();
  track.ghost.inputs = {};
  track.is_kept = false;
}

}  // namespace woodlouse::match
