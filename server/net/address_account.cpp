#include "server/net/address_account.h"

namespace woodlouse::server {

Duration AddressAccount::wait(Spending what, Time now) {
  const std::lock_guard lock(mutex_);
  return budgets_.wait(what, now);
}

void AddressAccount::charge(Spending what, double cost, Time now) {
  const std::lock_guard lock(mutex_);
  budgets_.charge(what, cost, now);
}

std::optional<Duration> AddressAccount::spend(Spending what, Time now) {
  const std::lock_guard lock(mutex_);
  return budgets_.spend(what, now);
}

std::optional<std::uint64_t> AddressAccount::take_log_line(Time now) {
  const std::lock_guard lock(mutex_);
  if (!budgets_.spend(Spending::kLogLines, now)) return std::exchange(lines_left_out_, 0);
  ++lines_left_out_;
  return std::nullopt;
}

bool AddressAccount::is_at_rest(Time now) {
  const std::lock_guard lock(mutex_);
  return lines_left_out_ == 0 && budgets_.are_full(now);
}

}  // namespace woodlouse::server
