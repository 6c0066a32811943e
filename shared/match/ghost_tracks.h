// What the lice of a race have asked for since they were at a spawn, kept as long as a run that counts may
// come of it: when one is done, its ghost is there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "shared/match/ghost.h"
#include "shared/match/match.h"
#include "shared/rules/event.h"
#include "shared/state/ghost.h"

namespace woodlouse::match {

/// A run that began at rest on a spawn, to its end.
struct DrivenRun {
  PlayerId player = 0;
  rules::Moment ended = 0;  ///< since tick 0
  rules::Moment time = 0;   ///< as a span
  bool is_kept = true;      ///< false: too long, or too much was asked for; the ghost is empty then
  state::Ghost ghost;
  RunTimes times;
  std::uint32_t counted_from = 0;  ///< the step, counted as the ghost's, from which on gates counted: they
                                   ///< don't between two rounds
};

/// Not thread safe: one owner.
class GhostTracks {
 public:
  /// Of all lice together: of whoever asks for more than there is left nothing is kept.
  static constexpr std::size_t kMostInputs = 1'000'000;

  explicit GhostTracks(std::uint32_t tick_hz) : tick_hz_(tick_hz) {}

  /// Each step of the match, one after the other. The runs that it ended; valid until the next call.
  std::vector<DrivenRun>& take(const StepRecord& step);

 private:
  struct Track {
    std::uint64_t begin = 0;  ///< the step that began at the spawn
    bool is_kept = true;
    state::Ghost ghost;
    std::vector<rules::Moment> gates;  ///< of the run, since tick 0
  };

  void take_roster(const StepRecord& step);
  void take_inputs(const StepRecord& step);
  void take_event(const StepRecord& step, const rules::Event& event);
  void forget(PlayerId player);
  void give_up(Track& track);
  [[nodiscard]] std::uint64_t most_ticks() const {
    return std::uint64_t{state::kMostGhostSeconds} * tick_hz_;
  }

  std::uint32_t tick_hz_;
  std::map<PlayerId, Track> tracks_;
  std::size_t inputs_ = 0;        ///< of all of them
  std::uint64_t play_began_ = 0;  ///< the tick from which on gates count
  std::vector<DrivenRun> done_;
};

}  // namespace woodlouse::match
