// Who may command at the admin door. Behind a Unix socket's mode everybody may; at a port who has the token.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "server/access/secret.h"
#include "server/timing/budgets.h"
#include "server/timing/clock.h"

namespace woodlouse::server {

/// One owner, no locking.
class AdminWatch {
 public:
  /// Of wrong tokens: so many at once, then one in that time. From one machine's own addresses, of which each
  /// may be taken by who likes, they count together.
  static constexpr double kMostWrong = 5.0;
  static constexpr double kWrongAgainSeconds = 10.0;

  /// token: none is needed where there is none.
  explicit AdminWatch(std::optional<Secret> token, Time now)
      : token_(std::move(token)), wrong_(1.0 / kWrongAgainSeconds, kMostWrong, now) {}

  enum class Verdict { kPass, kWrong, kLimited };
  /// Once too many were wrong, none is looked at for a while, so that guessing is slow.
  [[nodiscard]] Verdict judge(std::string_view token, Time now) {
    if (!token_) return Verdict::kPass;
    wrong_.charge(0.0, now);
    if (wrong_.wait(1.0) > Duration{}) return Verdict::kLimited;
    if (token_->matches(token)) return Verdict::kPass;
    wrong_.charge(1.0, now);
    return Verdict::kWrong;
  }
  [[nodiscard]] bool needs_token() const { return token_.has_value(); }

 private:
  std::optional<Secret> token_;
  TokenBucket wrong_;
};

}  // namespace woodlouse::server
