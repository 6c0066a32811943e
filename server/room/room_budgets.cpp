#include "server/room/room_budgets.h"

namespace woodlouse::server {

std::optional<Duration> RoomBudgets::spend(Spending what, AddressId address, Time now) {
  const auto is_quiet = [now](Time served) { return now >= served + kQuiet; };
  if (served_.size() >= kMostRemembered)
    std::erase_if(served_, [&](const auto& entry) { return is_quiet(entry.second); });
  const auto last = served_.find({what, address});
  const double kept = last == served_.end() || is_quiet(last->second) ? 0.0 : kKeptSeconds;
  if (const auto wait = budgets_.spend(what, now, kept)) return wait;
  served_.insert_or_assign({what, address}, now);
  return std::nullopt;
}

}  // namespace woodlouse::server
