// How many ticks a second the server makes, as its frames tell. Pure: time is an argument.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "shared/core/clock.h"

namespace woodlouse::client {

class TickRate {
 public:
  /// A game of so many ticks a second begins, of which so many frames a second come.
  void begin(std::uint32_t tick_hz, double frames_hz) {
    tick_hz_ = tick_hz;
    gap_ = std::chrono::duration<double>(std::max(1.0, 4.0 / std::max(0.1, frames_hz)));
    begin_anew();
  }
  /// What comes next is not measured against what came before: the game stood.
  void begin_anew() { has_begun_ = false; }
  /// A frame of `tick` came.
  void observe(std::uint64_t tick, core::Time now) {
    constexpr std::chrono::duration<double> kWindow(2.0);
    const bool has_waited = now - seen_ > gap_;  // we did: this program was stopped, or the line
    if (!has_begun_ || has_waited || tick < first_) begun_ = now, first_ = tick;
    has_begun_ = true;
    seen_ = now;
    const std::chrono::duration<double> passed = now - begun_;
    if (passed < kWindow) return;
    const double measured = static_cast<double>(tick - first_) / passed.count();
    if (measured < 1.1 * tick_hz_) hz_ = measured;  // more: what had waited for us came at once
    begun_ = now, first_ = tick;
  }
  /// Of the last two seconds that could be measured; 0: of none yet.
  [[nodiscard]] double hz() const { return hz_; }

 private:
  std::uint32_t tick_hz_ = 60;
  std::chrono::duration<double> gap_{1.0};
  bool has_begun_ = false;
  core::Time begun_{}, seen_{};  ///< the window, and the last frame
  std::uint64_t first_ = 0;
  double hz_ = 0.0;
};

}  // namespace woodlouse::client
