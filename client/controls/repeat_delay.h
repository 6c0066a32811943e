// How long a keyboard waits before a held key repeats, learnt from its own keys: where a terminal reports no
// releases a press pushes for a pulse, and a held key must come again before the pulse is over.
#pragma once

#include <chrono>
#include <optional>

#include "client/terminal/keyboard.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

/// Pure: time is an argument.
class RepeatDelay {
 public:
  static constexpr std::chrono::milliseconds kShortestPulse{400};
  static constexpr std::chrono::milliseconds kLongestPulse{1200};

  /// A key came, pressed or repeated.
  void observe(const Key& key, core::Time now);
  /// How long a press is to push: as long as nothing is learnt, and where keys repeat soon enough,
  /// kShortestPulse.
  [[nodiscard]] std::chrono::milliseconds pulse() const { return pulse_; }

 private:
  // Fingers are slower than three times in a row 10 a second, keyboards are not.
  static constexpr std::chrono::milliseconds kSlowestRepeat{100};
  static constexpr int kRepeats = 3;
  static constexpr std::chrono::milliseconds kMargin{100};

  std::optional<Key> key_;
  core::Time last_{};
  std::optional<core::Time::duration> delay_;  ///< the long gap before the short ones
  int repeats_ = 0;                            ///< short gaps since
  std::chrono::milliseconds pulse_ = kShortestPulse;
};

}  // namespace woodlouse::client
