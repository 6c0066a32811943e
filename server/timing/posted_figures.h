// A room's figures as they were when it last posted them.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "server/timing/figures.h"

namespace woodlouse::server {

/// Any thread: a lock is held to copy or swap a pointer.
class PostedFigures {
 public:
  void post(RoomFigures figures) {
    auto next = std::make_shared<const RoomFigures>(std::move(figures));
    const std::lock_guard lock(mutex_);
    std::swap(figures_, next);
  }
  /// Never null; unchanged, whatever comes after.
  [[nodiscard]] std::shared_ptr<const RoomFigures> now() const {
    const std::lock_guard lock(mutex_);
    return figures_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const RoomFigures> figures_ = std::make_shared<const RoomFigures>();
};

}  // namespace woodlouse::server
