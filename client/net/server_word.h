// Whether the server still speaks, and whether its game goes on: a server that hangs says nothing; of a
// paused room other answers come, and no frame, or one of the same tick again. Pure: time is an argument.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "shared/core/clock.h"

namespace woodlouse::client {

class ServerWord {
 public:
  /// An open line has a word every second: the answer to our ping.
  static constexpr std::chrono::milliseconds kSilence{1500};
  /// A tick that is shown for so long may stand, where frames come more often than three times in it.
  static constexpr std::chrono::milliseconds kLate{300};

  /// Of how many frames a second come.
  void expect(double frames_hz) {
    const std::chrono::duration<double> three_frames(3.0 / std::max(0.1, frames_hz));
    late_ =
        std::max<core::Time::duration>(kLate, std::chrono::duration_cast<core::Time::duration>(three_frames));
  }
  void heard(core::Time now) { heard_ = now; }
  /// A frame of `tick` came. True: the game goes on after it stood, or nothing was known of it.
  bool shown(std::uint64_t tick, core::Time now) {
    const bool stood = !goes_on(now);
    if (moved_ && tick == tick_) {
      stands_ = now - *moved_ > late_;
      return false;
    }
    tick_ = tick;
    moved_ = now;
    stands_ = false;
    return stood;
  }

  /// The answer came to what was asked at `asked`: frames from before it, which it can't overtake, would be
  /// here.
  void answered(core::Time asked) { stands_ = stands_ || (moved_ && asked - *moved_ > late_); }
  /// The server says so.
  void paused() { stands_ = moved_.has_value(); }

  /// The next tick should have been shown by now: time to ask.
  [[nodiscard]] bool is_late(core::Time now) const { return moved_ && now - *moved_ > late_; }
  /// Seconds without a word, when they are too many.
  [[nodiscard]] std::optional<double> silence(core::Time now) const {
    if (!heard_ || now - *heard_ < kSilence) return std::nullopt;
    return std::chrono::duration<double>(now - *heard_).count();
  }
  /// No tick passes.
  [[nodiscard]] bool stands() const { return stands_; }
  /// Whether what was last shown can be thought on to now.
  [[nodiscard]] bool goes_on(core::Time now) const { return moved_ && !stands_ && now - *moved_ < kSilence; }

 private:
  std::optional<core::Time> heard_;
  std::optional<core::Time> moved_;  ///< when the tick was first shown
  core::Time::duration late_ = kLate;
  std::uint64_t tick_ = 0;
  bool stands_ = false;
};

}  // namespace woodlouse::client
