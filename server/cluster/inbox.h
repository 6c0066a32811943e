// What comes to a node's thread, from rooms and from NATS, in its order; what rooms tell is bounded.
#pragma once

#include <atomic>
#include <cassert>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <utility>
#include <variant>

#include "server/cluster/cluster_settings.h"
#include "server/cluster/log_tap.h"
#include "server/timing/clock.h"

namespace woodlouse::server {

struct LogMessage {
  std::uint64_t sequence = 0;
  std::string bytes;
  std::uint64_t reading = 0;  ///< of that beginning to read; of one before it is nothing any more
};
struct Acknowledged {
  std::uint64_t sequence = 0;
};
struct Refused {
  std::string why;
};
/// There is something to look at that stands elsewhere.
struct Nudge {};
using NodeEvent = std::variant<LogDesk::Job, LogMessage, Acknowledged, Refused, Nudge>;

/// Any thread.
class Inbox final : public LogDesk {
 public:
  /// Of what rooms tell: 5 s of as many as there may be at 60 Hz.
  static constexpr std::size_t kMostJobs = kMostRoomsOfShard * 300;

  [[nodiscard]] bool post(Job job) override {
    const std::lock_guard lock(mutex_);
    if (jobs_ >= kMostJobs) return false;
    ++jobs_;
    events_.emplace_back(std::move(job));
    // A tick needn't wake anybody: its line waits for the batch.
    return true;
  }
  void post_soon(Job job) override {
    const std::lock_guard lock(mutex_);
    events_.emplace_back(std::move(job));
    changed_.notify_one();
  }
  void doubt() override {
    is_in_doubt_ = true;
    put(Nudge{});
  }
  [[nodiscard]] bool is_in_doubt() const override { return is_in_doubt_; }
  /// The log has been asked: it is this host's.
  void settle() { is_in_doubt_ = false; }
  [[nodiscard]] std::uint64_t beginnings() const override { return beginnings_; }
  void begin_anew() { ++beginnings_; }
  void put(NodeEvent event) {
    assert(!std::holds_alternative<LogDesk::Job>(event));
    const std::lock_guard lock(mutex_);
    events_.push_back(std::move(event));
    changed_.notify_one();
  }
  void stop() {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
    changed_.notify_one();
  }
  [[nodiscard]] bool is_stopping() const {
    const std::lock_guard lock(mutex_);
    return is_stopping_;
  }
  /// Waits for something that is waited for, or of NATS, or until then; all that has come.
  [[nodiscard]] std::deque<NodeEvent> take(Time until) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, until, [this] { return is_stopping_ || events_.size() > jobs_; });
    jobs_ = 0;
    return std::exchange(events_, {});
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<NodeEvent> events_;
  std::size_t jobs_ = 0;
  bool is_stopping_ = false;
  std::atomic<bool> is_in_doubt_{false};
  std::atomic<std::uint64_t> beginnings_{0};
};

}  // namespace woodlouse::server
