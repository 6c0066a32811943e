// How much of what costs others somebody may ask for: a session, an address, a room, each has such budgets.
// Pure: time is an argument. One owner, no locking.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "server/timing/clock.h"
#include "shared/protocol/limits.h"

namespace woodlouse::server {

/// `rate` tokens come in a second, at most `burst` are kept. May be overdrawn: then nothing is given until
/// that is made up for.
class TokenBucket {
 public:
  TokenBucket(double rate, double burst, Time now) : rate_(rate), burst_(burst), tokens_(burst), at_(now) {}

  /// Takes `cost` tokens if they are there.
  bool take(double cost, Time now);
  /// Takes them, there or not.
  void charge(double cost, Time now);
  /// How long until `cost` tokens would be there; zero: now. At most an hour.
  [[nodiscard]] Duration wait(double cost) const;
  [[nodiscard]] bool is_full(Time now);
  [[nodiscard]] double rate() const { return rate_; }

 private:
  void refill(Time now);

  double rate_;
  double burst_;
  double tokens_;
  Time at_;
};

enum class Spending : std::uint8_t { kChat, kRespawn, kJoin, kAnswerBytes, kLogLines, kLineBytes };

inline constexpr std::size_t kSpendings = 6;

/// A bucket for each kind, which keeps kSavedSeconds' worth. What is bigger than all that is there is given
/// too, while there is something; the next waits until it is paid off.
class Budgets {
 public:
  /// Of Spending, a second; none: without bound.
  using Rates = std::array<std::optional<double>, kSpendings>;

  Budgets(const Rates& rates, Time now);

  /// How long until something is given, and so many seconds' worth is left behind it; zero: now.
  [[nodiscard]] Duration wait(Spending what, Time now, double kept_s = 0.0);
  void charge(Spending what, double cost, Time now);
  /// Charges 1 where that is given now, else says how long to wait.
  [[nodiscard]] std::optional<Duration> spend(Spending what, Time now, double kept_s = 0.0);
  /// Nothing is remembered: a new one would be the same.
  [[nodiscard]] bool are_full(Time now);

 private:
  std::array<std::optional<TokenBucket>, kSpendings> buckets_;
};

[[nodiscard]] Budgets::Rates session_rates(const protocol::Limits& limits);
[[nodiscard]] Budgets::Rates address_rates(const protocol::Limits& limits);
[[nodiscard]] Budgets::Rates room_rates(const protocol::Limits& limits);

/// In whole milliseconds, at least 1, as an error's retry_after_ms.
[[nodiscard]] std::uint32_t retry_after_ms(Duration wait);

}  // namespace woodlouse::server
