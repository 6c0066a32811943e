#include "shared/rules/rules.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include "shared/core/stable_hash.h"
#include "shared/rules/forage.h"
#include "shared/rules/hill.h"
#include "shared/rules/race.h"

namespace woodlouse::rules {

std::unique_ptr<Rules> Rules::make(state::Mode mode, const map::Map& map, std::uint32_t tick_hz) {
  assert(map.definition.modes.has(mode));
  switch (mode) {
    case state::Mode::kRace:
      return std::make_unique<Race>(map, tick_hz);
    case state::Mode::kForage:
      return std::make_unique<Forage>(map, tick_hz);
    case state::Mode::kHill:
      return std::make_unique<Hill>(map, tick_hz);
    case state::Mode::kRoam:
      break;
  }
  return nullptr;
}

Rules::Rules(state::Mode mode, const map::Map& map, std::uint32_t tick_hz, const RoundLengths& lengths)
    : mode_(mode), map_(map), tick_hz_(tick_hz), lengths_(lengths) {
  assert(tick_hz >= 1 && lengths.play > 0 && lengths.podium > 0);
}

void Rules::join(state::LouseId louse) {
  assert(!plays(louse));
  ids_.insert(std::lower_bound(ids_.begin(), ids_.end(), louse), louse);
  on_join(louse);
  note_change();
}

void Rules::leave(state::LouseId louse) {
  if (!plays(louse)) return;
  ids_.erase(std::lower_bound(ids_.begin(), ids_.end(), louse));
  on_leave(louse);
  note_change();
}

void Rules::respawn(state::LouseId louse) {
  if (!plays(louse)) return;
  on_respawn(louse);
  note_change();
}

void Rules::respawn_at_gate(state::LouseId louse) {
  assert(plays(louse) && last_gate(louse));
  on_respawn_at_gate(louse);
  note_change();
}

void Rules::after_step(physics::World& world, std::uint64_t tick, std::uint64_t hash) {
  assert(world.events().size() == world.lice().size());
  events_.clear();
  Step step{world, tick, hash};
  if (round_.phase != Phase::kGather) judge(step);
  move_clock(step);
  std::stable_sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
    return std::tie(a.louse, a.moment) < std::tie(b.louse, b.moment);
  });
  if (!has_changed_) return;
  has_changed_ = false;
  bytes_.clear();
  write_all(bytes_);
  hash_ = core::stable_hash(bytes_.bytes());
}

terrain::SurfaceSample Rules::ground_at(core::Vec2 place) const {
  const terrain::Rectangle& domain = map_.terrain->domain();
  return map_.terrain->sample(std::clamp(place.x, domain.x_min, domain.x_max),
                              std::clamp(place.y, domain.y_min, domain.y_max));
}

/// At the end of a step: from phase to phase.
void Rules::move_clock(Step& step) {
  const std::uint64_t now = step.tick + 1;
  const bool is_won = std::exchange(is_round_won_, false);
  const bool is_over = is_won || now >= round_.until;
  if (ids_.empty()) {
    if (round_.phase != Phase::kGather) note_change();
    round_ = {};
    return;
  }
  switch (round_.phase) {
    case Phase::kGather:
      begin_round(step);
      break;
    case Phase::kCountdown:
      if (is_over) play(step);
      break;
    case Phase::kPlay:
      if (is_over) begin_phase(Phase::kPodium, now, lengths_.podium);
      break;
    case Phase::kPodium:
      if (is_over) begin_round(step);
      break;
  }
}

void Rules::begin_round(Step& step) {
  ++round_.number;
  if (lengths_.countdown == 0) return play(step);
  begin_phase(Phase::kCountdown, step.tick + 1, lengths_.countdown);
}

void Rules::play(Step& step) {
  begin_phase(Phase::kPlay, step.tick + 1, lengths_.play);
  on_round(step);
}

void Rules::begin_phase(Phase phase, std::uint64_t tick, std::uint64_t length) {
  assert(length > 0);
  round_.phase = phase;
  round_.until = tick + length;
  note_change();
  say({EventKind::kRound,
       0,
       tick * kMomentsPerTick,
       {round_.number, static_cast<std::int64_t>(phase), static_cast<std::int64_t>(round_.until), 0}});
}

void Rules::write_all(StateWriter& out) const {
  out.put(static_cast<std::uint8_t>(round_.phase), round_.number, round_.until);
  write(out);
}

std::string Rules::state() const {
  StateWriter out;
  if (hash_ == 0) return {};
  write_all(out);
  return out.bytes();
}

bool Rules::restore(std::string_view state, std::span<const state::LouseId> ids) {
  assert(hash_ == 0 && ids_.empty());
  if (state.empty()) return ids.empty();
  StateReader in(state);
  const auto phase = in.get<std::uint8_t>();
  round_.number = in.get<std::uint32_t>();
  round_.until = in.get<std::uint64_t>();
  round_.phase = static_cast<Phase>(phase % kPhases);
  ids_.assign(ids.begin(), ids.end());
  const bool fits = phase < kPhases && (round_.phase == Phase::kGather) == (round_.until == 0);
  if (!read(in, ids) || !in.is_whole() || !fits) return false;
  has_changed_ = false;
  hash_ = core::stable_hash(state);
  return true;
}

}  // namespace woodlouse::rules
