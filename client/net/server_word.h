// Whether the server still speaks, and whether its game goes on: a server that hangs says nothing, a paused
// room shows the same tick again and again. Pure: time is an argument.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "shared/core/clock.h"

namespace woodlouse::client {

class ServerWord {
 public:
  /// An open line has a word every second: the answer to our ping.
  static constexpr std::chrono::milliseconds kSilence{1500};
  /// A tick that is shown for so long stands; a frame of it may come twice.
  static constexpr std::chrono::milliseconds kStands{200};

  void heard(core::Time now) { heard_ = now; }
  /// A frame of `tick` came. True: the game goes on after it stood, or nothing was known of it.
  bool shown(std::uint64_t tick, core::Time now) {
    const bool stood = !goes_on(now);
    if (moved_ && tick == tick_) {
      stands_ = now - *moved_ > kStands;
      return false;
    }
    tick_ = tick;
    moved_ = now;
    stands_ = false;
    return stood;
  }

  /// Seconds without a word, when they are too many.
  [[nodiscard]] std::optional<double> silence(core::Time now) const {
    if (!heard_ || now - *heard_ < kSilence) return std::nullopt;
    return std::chrono::duration<double>(now - *heard_).count();
  }
  /// Frames show that no tick passes.
  [[nodiscard]] bool stands() const { return stands_; }
  /// Whether what was last shown can be thought on to now.
  [[nodiscard]] bool goes_on(core::Time now) const { return moved_ && !stands_ && now - *moved_ < kSilence; }

 private:
  std::optional<core::Time> heard_;
  std::optional<core::Time> moved_;  ///< when the tick was first shown
  std::uint64_t tick_ = 0;
  bool stands_ = false;
};

}  // namespace woodlouse::client
