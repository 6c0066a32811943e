// The server's tick, as a smooth function of the client's time: frames arrive early or late by the network's
// whims, and what is drawn must not.
//
// Each frame's arrival says tick - seconds * tick_hz: the earliest arrivals (the largest values) are the true
// line, everything below is delay. The line follows a new maximum at once, sinks slowly otherwise (the clocks
// drift, routes change), and falls when kLateFrames running agree that it must: a server that fell behind and
// moved its clock. What is shown slews towards the line, by 5 % of real time at most, and jumps beyond kJump.
#pragma once

#include <cstdint>

#include "shared/core/clock.h"

namespace woodlouse::client {

class ServerClock {
 public:
  explicit ServerClock(std::uint32_t tick_hz) : tick_hz_(tick_hz) {}

  /// A frame of `tick` arrived.
  void observe(std::uint64_t tick, core::Time arrival);

  /// Whether any frame has arrived, so that tick() means something.
  [[nodiscard]] bool running() const { return running_; }
  /// The tick whose frame, on time, arrives at `now`. Never falls between calls but by a jump. REQUIRES
  /// running().
  double tick(core::Time now);
  [[nodiscard]] double tick_hz() const { return tick_hz_; }

 private:
  static constexpr int kLateFrames = 10;
  static constexpr double kLateSeconds = 0.08;   ///< this far below the line a frame counts as late
  static constexpr double kSinkSeconds = 0.002;  ///< a second
  static constexpr double kSlew = 0.05;          ///< seconds a second
  static constexpr double kJump = 0.5;           ///< seconds

  [[nodiscard]] double elapsed(core::Time now) const;

  double tick_hz_;
  bool running_ = false;
  core::Time origin_{};
  core::Time last_observed_{};
  core::Time last_shown_{};
  double line_ = 0.0;    ///< ticks, at origin_
  double shown_ = 0.0;   ///< the same, slewed
  double latest_ = 0.0;  ///< what tick() last said
  int late_frames_ = 0;
  double best_late_ = 0.0;
};

}  // namespace woodlouse::client
