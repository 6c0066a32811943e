// How many lines a session may send: a token bucket, and a second one that tells a slip from a flood.
// Pure: time is an argument. One owner, no locking.
#pragma once

#include <cstdint>

#include "server/room/clock.h"

namespace woodlouse::server {

/// `rate` tokens come in a second, at most `burst` are kept.
class TokenBucket {
 public:
  TokenBucket(double rate, double burst, Time now) : rate_(rate), burst_(burst), tokens_(burst), at_(now) {}

  /// Takes `cost` tokens if they are there.
  bool take(double cost, Time now);
  /// How long until `cost` tokens would be there; zero: now.
  [[nodiscard]] Duration wait(double cost) const;

 private:
  double rate_;
  double burst_;
  double tokens_;
  Time at_;
};

/// The limit that hello declares. Lines past it are refused with the time to wait; who goes on sending half
/// as much again as allowed, for kPatience bursts of refusals, is a flood.
class RateLimiter {
 public:
  static constexpr double kPatience = 4.0;

  enum class Verdict { kPass, kRefuse, kFlood };

  RateLimiter(std::uint32_t messages_per_s, std::uint32_t burst, Time now)
      : messages_(messages_per_s, burst, now), refusals_(messages_per_s / 2.0, kPatience * burst, now) {}

  /// A line has come. cost: what it weighs, 1 for most (kBroadcastCost for what goes out to a whole room).
  Verdict take(Time now, double cost = 1.0);
  /// After kRefuse: milliseconds until a line of that cost would pass, at least 1.
  [[nodiscard]] std::uint32_t retry_after_ms(double cost = 1.0) const;

 private:
  TokenBucket messages_;
  TokenBucket refusals_;
};

}  // namespace woodlouse::server
