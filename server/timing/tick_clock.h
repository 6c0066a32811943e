// When each tick is due: an absolute schedule, so that compute time never adds up to a drift.
// Pure: knows no timer and asks no clock. One owner, no locking.
#pragma once

#include <cstdint>

#include "server/timing/clock.h"

namespace woodlouse::server {

/// Tick n is due at origin + n / tick_hz. A server that is late by more than kMaxLateTicks ticks does not try
/// to make up for it: it moves its clock (the origin) and counts the move. Tick numbers never skip.
class TickClock {
 public:
  static constexpr std::uint32_t kMaxLateTicks = 5;

  /// tick_hz >= 1. The first tick is due at `start`.
  TickClock(std::uint32_t tick_hz, Time start) : tick_hz_(tick_hz), origin_(start) {}

  /// When the next tick is due.
  [[nodiscard]] Time deadline() const { return origin_ + offset(begun_); }

  /// Begins the next tick's work at `now` and returns how late that is, >= 0. REQUIRES now >= deadline().
  /// Later than kMaxLateTicks ticks: the schedule moves so that this tick was due now.
  Duration begin(Time now);

  /// No time has passed, whatever there was: the next tick is due at `now`.
  void restart(Time now);

  /// How often the clock was moved.
  [[nodiscard]] std::uint64_t moves() const { return moves_; }
  /// Length of one tick, rounded down to the clock's unit.
  [[nodiscard]] Duration period() const { return offset(1); }

 private:
  [[nodiscard]] Duration offset(std::uint64_t ticks) const;

  std::uint32_t tick_hz_;
  Time origin_;
  std::uint64_t begun_ = 0;  ///< ticks begun since origin_
  std::uint64_t moves_ = 0;
};

}  // namespace woodlouse::server
