// The limits of a server, which its operator may change while it runs.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "shared/protocol/limits.h"

namespace woodlouse::server {

/// Any thread: a lock is held to copy or swap a pointer.
class LiveLimits {
 public:
  explicit LiveLimits(const protocol::Limits& limits)
      : limits_(std::make_shared<const protocol::Limits>(limits)) {}

  /// Never null; unchanged, whatever comes after.
  [[nodiscard]] std::shared_ptr<const protocol::Limits> now() const {
    const std::lock_guard lock(mutex_);
    return limits_;
  }
  void replace(const protocol::Limits& limits) {
    auto next = std::make_shared<const protocol::Limits>(limits);
    const std::lock_guard lock(mutex_);
    std::swap(limits_, next);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const protocol::Limits> limits_;
};

}  // namespace woodlouse::server
