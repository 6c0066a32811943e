// The error figure of one louse while it is played, for who asks: what step_error.h and twin.h say of ticks
// that come one by one and of which the newest may still turn out to have been others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "shared/map/map_definition.h"
#include "shared/match/error_reading.h"
#include "shared/match/step_error.h"
#include "shared/match/twin.h"
#include "shared/state/louse.h"
#include "shared/state/mode.h"

namespace woodlouse::match {

/// One thread at a time.
class LiveError {
 public:
  static constexpr std::size_t kMostWaiting =
      2048;  ///< ticks found and not counted; the oldest are forgotten

  /// tick: the room's [s], > 0. settling: how many ticks old one is before it counts. REQUIRES a map in full
  /// detail, which has the mode.
  LiveError(const map::Map& map, double tick, state::Mode mode, std::uint64_t settling = 0);

  /// The louse as the step of number `tick` finds it: with this step's input, not yet moved. What was found
  /// of this tick and later ones was no play and is forgotten, but where it has counted: no tick counts
  /// twice.
  void find(const state::Louse& louse, std::uint64_t tick);
  /// What was found and has not counted was no play either.
  void forget_waiting() { waiting_.clear(); }
  /// Counts what is old enough, at most so many ticks; a tick costs StepError's steps and the twin's two.
  void count(std::size_t most);

  /// Of the ticks that have counted; nothing before the first.
  [[nodiscard]] std::optional<ErrorReading> reading() const;

 private:
  struct Found {
    std::uint64_t tick;
    state::Louse louse;
  };

  double tick_seconds_;
  std::uint64_t settling_;
  StepError error_;
  Twin twin_;
  std::deque<Found> waiting_;  ///< ascending ticks
  std::uint64_t next_ = 0;     ///< those before have counted
  state::LouseId counted_ = 0;
};

}  // namespace woodlouse::match
