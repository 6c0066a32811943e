// Plays scenarios: each is a match of its own, and several are stepped in turns by several threads, as a
// server's rooms are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/scenario/scenario.h"
#include "shared/core/team.h"
#include "shared/match/match.h"
#include "shared/physics/batch.h"

namespace woodlouse::scenario {

/// One match of a scenario. Refers to it. Not thread safe.
class Play {
 public:
  /// team: who shares its steps; null: nobody. REQUIRES is_available(set).
  Play(const Scenario& scenario, physics::InstructionSet set,
       const std::shared_ptr<core::Team>& team = nullptr);

  [[nodiscard]] bool is_done() const { return match_.tick() == scenario_->last_tick(); }
  /// Performs the next steps, up to `count`.
  void advance(std::uint64_t count);

  [[nodiscard]] const Scenario& scenario() const { return *scenario_; }
  [[nodiscard]] physics::InstructionSet instructions() const { return set_; }
  /// At the scenario's ticks so far.
  [[nodiscard]] const std::vector<std::uint64_t>& hashes() const { return hashes_; }
  /// What the rules of play said so far, as texts (rules/event.h).
  [[nodiscard]] const std::vector<std::string>& rulings() const { return rulings_; }
  [[nodiscard]] const match::Match& match() const { return match_; }
  /// What the last one did; until the next. REQUIRES one.
  [[nodiscard]] const match::StepRecord& last_step() const { return *last_step_; }

 private:
  void apply(const Event& event);

  const Scenario* scenario_;
  physics::InstructionSet set_;
  match::Match match_;
  std::size_t next_event_ = 0;
  std::vector<std::uint32_t> seqs_;  ///< the last one of each player, by number
  std::vector<std::uint64_t> hashes_;
  std::vector<std::string> rulings_;
  const match::StepRecord* last_step_ = nullptr;
};

/// Plays all to their ends. Every thread takes the play that waited longest, a few steps at a time, so that a
/// match wanders between threads and lies between others.
void play_all(std::span<const std::unique_ptr<Play>> plays, std::size_t threads);

}  // namespace woodlouse::scenario
