// What a room allows all its addresses together. One owner, no locking. Pure: time is an argument.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "server/frames/layouts.h"
#include "server/timing/budgets.h"
#include "server/timing/clock.h"
#include "shared/protocol/limits.h"

namespace woodlouse::server {

class RoomBudgets {
 public:
  RoomBudgets(const protocol::Limits& limits, Time now) : budgets_(room_rates(limits), now) {}

  /// As Budgets::spend(). The last second's worth is for addresses that have had nothing for kQuiet: a few
  /// that ask on and on can't keep out everybody else.
  [[nodiscard]] std::optional<Duration> spend(Spending what, AddressId address, Time now);

 private:
  static constexpr Duration kQuiet = std::chrono::seconds(2);
  static constexpr double kKeptSeconds = 1.0;
  static constexpr std::size_t kMostRemembered = 4096;

  Budgets budgets_;
  std::map<std::pair<Spending, AddressId>, Time> served_;  ///< when each last had something; old ones go
};

}  // namespace woodlouse::server
