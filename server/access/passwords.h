// Who may join at all, and as what: tokens by role, from a file. A line is a role and a token:
//
//     player     correct-horse-battery
//     moderator  staple-of-the-house      # kicks, mutes, says
//
// Roles: player, moderator, admin, each of which may what those before it may. Several tokens may have one
// role.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/secret.h"
#include "server/timing/budgets.h"
#include "server/timing/clock.h"
#include "shared/core/error.h"

namespace woodlouse::server {

enum class Right : std::uint8_t { kPlayer, kModerator, kAdmin };

/// Immutable; any thread.
class Passwords {
 public:
  static constexpr std::size_t kMost = 256;

  /// Errors: where = `name` and the line; none shows what is in it.
  static core::Expected<Passwords> parse(std::string_view text, const std::string& name);

  /// Nothing: it is none of them. In the same time, whichever it is.
  [[nodiscard]] std::optional<Right> right_of(std::string_view token) const;

 private:
  std::vector<std::pair<Secret, Right>> tokens_;
};

core::Expected<Passwords> read_passwords(const std::filesystem::path& file);

/// How often somebody may say a wrong one. Pure. One owner, no locking.
class WrongTokens {
 public:
  static constexpr double kAtOnce = 5.0;         ///< of an address
  static constexpr double kAgainSeconds = 10.0;  ///< then one in that time
  /// Addresses that are told apart; those that come once there are so many are counted together.
  static constexpr std::size_t kMostAddresses = 4096;

  /// How long until one of that address is looked at; zero: now.
  [[nodiscard]] Duration wait(std::string_view address, Time now);
  void count(std::string_view address, Time now);

 private:
  [[nodiscard]] TokenBucket& bucket(std::string_view address, Time now);

  std::map<std::string, TokenBucket, std::less<>> of_;
};

}  // namespace woodlouse::server
