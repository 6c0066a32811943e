// When a room's next tick is due, for who looks after it from outside.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cstdint>

#include "server/timing/clock.h"

namespace woodlouse::server {

/// The room's strand says when, any thread asks; neither takes a lock.
class NextTick {
 public:
  /// A room whose next tick has been due for so many, and so long, does not serve as it should.
  static constexpr std::uint32_t kLateTicks = 30;
  static constexpr std::chrono::milliseconds kLate{500};

  explicit NextTick(std::uint32_t tick_hz)
      : too_late_(std::max<Duration>(kLate, std::chrono::seconds(kLateTicks) / tick_hz)) {
    assert(tick_hz > 0);
  }

  void expect(Time due) { due_.store(due, std::memory_order_relaxed); }
  /// The room stands still.
  void expect_none() { expect(Time::max()); }

  /// For how long it has been due, or has been worked on since; zero where none is.
  [[nodiscard]] Duration overdue(Time now) const {
    return std::max(Duration{}, now - std::min(now, due_.load(std::memory_order_relaxed)));
  }
  [[nodiscard]] bool is_too_late(Time now) const { return overdue(now) > too_late_; }

 private:
  const Duration too_late_;
  std::atomic<Time> due_{Time::max()};
};

}  // namespace woodlouse::server
