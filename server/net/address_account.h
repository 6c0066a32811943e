// What all connections of one address may do together.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "server/frames/layouts.h"
#include "server/timing/budgets.h"
#include "server/timing/clock.h"
#include "shared/protocol/limits.h"

namespace woodlouse::server {

/// Any thread: its sessions are on several, and a lock is held for a look-up.
class AddressAccount {
 public:
  /// name: for people, in the log.
  AddressAccount(AddressId id, std::string name, const protocol::Limits& limits, Time now)
      : id_(id), name_(std::move(name)), budgets_(address_rates(limits), now) {}

  [[nodiscard]] AddressId id() const { return id_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  [[nodiscard]] Duration wait(Spending what, Time now);
  void charge(Spending what, double cost, Time now);
  [[nodiscard]] std::optional<Duration> spend(Spending what, Time now);
  /// Whether a line about this address may be logged now; then also how many were left out before it.
  [[nodiscard]] std::optional<std::uint64_t> take_log_line(Time now);
  /// Nothing is remembered: a new one would be the same.
  [[nodiscard]] bool is_at_rest(Time now);

 private:
  const AddressId id_;
  const std::string name_;
  std::mutex mutex_;
  Budgets budgets_;
  std::uint64_t lines_left_out_ = 0;
};

}  // namespace woodlouse::server
