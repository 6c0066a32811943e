// How much of the state a slow client is sent: full rate -> half rate -> keys only -> bye, and back.
// Pure: time is an argument. One owner, no locking.
#pragma once

#include <cstdint>
#include <optional>

#include "server/frames/frame.h"
#include "server/timing/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Judges a client by the frames that had to be replaced because it had not taken the one before.
class SendRate {
 public:
  enum class Pace : std::uint8_t { kFull, kHalf, kKeysOnly };
  enum class Change {
    kNone,
    kLowered,   ///< pace() went down a step: tell the client
    kRestored,  ///< pace() went up a step: tell the client
    kGiveUp,    ///< it takes not even keys: end it with bye `slow`
  };

  static constexpr Duration kWindow = std::chrono::seconds(2);      ///< over which a client is judged
  static constexpr Duration kLastWindow = std::chrono::seconds(6);  ///< the same when only keys are sent
  /// Without a replaced frame for so long, the rate goes up a step; doubled each time that proved too early,
  /// up to kRestoreMost, and forgotten after kRestoreMost at full rate.
  static constexpr Duration kRestoreAfter = std::chrono::seconds(10);
  static constexpr Duration kRestoreMost = std::chrono::seconds(80);

  explicit SendRate(Time now) : window_(now), clean_since_(now) {}

  /// Does this frame go out at the present pace? divisor: the client takes every divisor-th frame anyway.
  [[nodiscard]] bool wants(const Frame& frame, std::uint64_t divisor) const;
  /// A frame goes out; `replaced`: the one before was still unsent.
  Change on_frame(Time now, bool replaced);
  [[nodiscard]] Pace pace() const { return pace_; }
  /// What the client is told of the change that has just led to pace(); nothing for kNone and kGiveUp.
  [[nodiscard]] std::optional<protocol::Notice> notice(Change change) const;

 private:
  Change lower(Time now);
  Change judge(Time now);

  Pace pace_ = Pace::kFull;
  Time window_;  ///< its begin
  std::uint32_t offered_ = 0;
  std::uint32_t replaced_ = 0;
  Time clean_since_;  ///< no frame was replaced since
  Duration restore_after_ = kRestoreAfter;
  bool on_trial_ = false;  ///< the present pace was restored, not yet proved
};

}  // namespace woodlouse::server
