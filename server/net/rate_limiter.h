// How many lines a session may send: a token bucket, and a second one that tells a slip from a flood.
// Pure: time is an argument. One owner, no locking.
#pragma once

#include <cstdint>

#include "server/timing/budgets.h"
#include "server/timing/clock.h"

namespace woodlouse::server {

/// The limit that hello declares. Lines past it are refused with the time to wait; who goes on sending half
/// as much again as allowed, for kPatience bursts of refusals, is a flood.
class RateLimiter {
 public:
  static constexpr double kPatience = 4.0;

  enum class Verdict { kPass, kRefuse, kFlood };

  RateLimiter(std::uint32_t messages_per_s, std::uint32_t burst, Time now)
      : messages_(messages_per_s, burst, now), refusals_(messages_per_s / 2.0, kPatience * burst, now) {}

  /// A line has come.
  Verdict take(Time now);
  /// After kRefuse: how long until one would pass.
  [[nodiscard]] Duration wait() const { return messages_.wait(1.0); }

 private:
  TokenBucket messages_;
  TokenBucket refusals_;
};

}  // namespace woodlouse::server
