// When steps that come in parts are to be shown: as evenly as they were played. Each part's arrival says when
// its last step was played, at the latest; the earliest arrivals are the true line, all behind it is delay.
// What is shown is `delay` behind that line, so that the next part is there before the last one is used up.
// Pure: time is an argument. One owner.
#pragma once

#include <cstdint>
#include <optional>

#include "server/timing/clock.h"

namespace woodlouse::server {

class Playout {
 public:
  /// By so much later, the room stood still, or its clock was moved: the line begins anew.
  static constexpr Duration kStood = std::chrono::milliseconds(500);
  /// So many parts running that come late by more than kLate move the line to the earliest of them.
  static constexpr int kLateParts = 10;
  static constexpr Duration kLate = std::chrono::milliseconds(40);

  /// tick_hz >= 1. delay: from one part to the next, and what their ways differ by.
  Playout(std::uint32_t tick_hz, Duration delay);

  /// No game lasts longer: what says so is none. [s]
  static constexpr std::uint64_t kLongestGame = std::uint64_t{1} << 32;

  /// All steps before `tick` are here. One of no game says nothing.
  void came(std::uint64_t tick, Time now);
  /// When step `tick` is to be shown; before anything came, or of no game: at once.
  [[nodiscard]] Time due(std::uint64_t tick) const;

 private:
  [[nodiscard]] bool is_of_a_game(std::uint64_t tick) const { return tick / tick_hz_ <= kLongestGame; }
  [[nodiscard]] Duration after(std::uint64_t ticks) const;

  std::uint32_t tick_hz_;
  Duration delay_;
  std::optional<Time> origin_;  ///< when tick 0 was played, by the earliest arrivals
  int late_parts_ = 0;
  Time best_late_{};
};

}  // namespace woodlouse::server
