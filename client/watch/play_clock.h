// Where a recording is being watched: position, speed, playing or paused. Pure: time is an argument, keys
// become calls.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shared/core/clock.h"

namespace woodlouse::client {

class PlayClock {
 public:
  static constexpr std::array<double, 7> kSpeeds = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
  /// Time that passed at once without an update counts for no more: the viewer was stopped, or can't keep up.
  static constexpr std::chrono::milliseconds kLongestGap{250};

  /// Begins at `first`, playing. REQUIRES first <= last and tick_hz > 0.
  PlayClock(std::uint64_t first, std::uint64_t last, std::uint32_t tick_hz);

  /// Runs on to now; pauses at the end.
  void update(core::Time now);

  /// Play or pause; at the end: from the beginning again.
  void toggle();
  /// One tick forth (+1) or back (-1); pauses.
  void step(int ticks);
  void skip(double seconds);
  /// 0 is the beginning, 1 the end.
  void jump(double fraction);
  /// Clamped to the recording.
  void go_to(std::uint64_t tick);
  void faster();
  void slower();

  [[nodiscard]] std::uint64_t tick() const { return static_cast<std::uint64_t>(position_); }
  [[nodiscard]] std::uint64_t first() const { return first_; }
  [[nodiscard]] std::uint64_t last() const { return last_; }
  [[nodiscard]] bool is_playing() const { return playing_; }
  [[nodiscard]] double speed() const { return kSpeeds[speed_]; }
  /// Since the beginning.
  [[nodiscard]] double seconds() const { return seconds_of(tick()); }
  [[nodiscard]] double total_seconds() const { return seconds_of(last_); }

 private:
  void place(double position);
  [[nodiscard]] double seconds_of(std::uint64_t tick) const {
    return static_cast<double>(tick - first_) / tick_hz_;
  }

  std::uint64_t first_;
  std::uint64_t last_;
  double tick_hz_;
  double position_;  ///< [ticks], first_ .. last_
  std::size_t speed_ = 2;
  bool playing_ = true;
  std::optional<core::Time> updated_;
};

}  // namespace woodlouse::client
