// Who hears what NATS brings. libnats doesn't say when its last call is over: an ear that is closed hears
// nothing, and is kept, to be another's after a while.
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/cluster/nats_link.h"
#include "server/timing/clock.h"

namespace woodlouse::server {

/// Any thread.
class Ear {
 public:
  static Ear* make(NatsLink::Told told, NatsMessageTaken taken) {
    // Never destroyed: threads of libnats may still call while the process ends.
    static std::mutex& all_mutex = *new std::mutex;
    static std::vector<std::unique_ptr<Ear>>& all = *new std::vector<std::unique_ptr<Ear>>;
    const std::lock_guard lock(all_mutex);
    const auto idle = std::find_if(all.begin(), all.end(), [](const auto& ear) { return ear->is_idle(); });
    Ear* const ear = idle != all.end() ? idle->get() : all.emplace_back(std::make_unique<Ear>()).get();
    const std::lock_guard own(ear->mutex_);
    ear->closed_at_.reset();
    ear->told_ = std::move(told);
    ear->taken_ = std::move(taken);
    return ear;
  }
  /// A call that is under way has ended when this returns.
  void close() {
    const std::lock_guard lock(mutex_);
    told_ = {};
    taken_ = {};
    closed_at_ = Clock::now();
  }
  void on_stored(std::uint64_t sequence) {
    const std::lock_guard lock(mutex_);
    if (told_.acknowledged) told_.acknowledged(sequence);
  }
  void on_refused(std::string why) {
    const std::lock_guard lock(mutex_);
    if (told_.refused) told_.refused(std::move(why));
  }
  void on_connected(bool is_connected) {
    const std::lock_guard lock(mutex_);
    if (told_.connected) told_.connected(is_connected);
  }
  void on_closed() {
    const std::lock_guard lock(mutex_);
    if (told_.closed) told_.closed();
  }
  void on_message(std::string subject, std::string bytes, std::uint64_t sequence) {
    const std::lock_guard lock(mutex_);
    if (taken_) taken_(std::move(subject), std::move(bytes), sequence);
  }

 private:
  /// Closed for so long that no call is under way.
  [[nodiscard]] bool is_idle() {
    constexpr Duration kLongAgo = std::chrono::seconds(60);
    const std::lock_guard lock(mutex_);
    return closed_at_ && Clock::now() - *closed_at_ > kLongAgo;
  }

  std::mutex mutex_;
  std::optional<Time> closed_at_;
  NatsLink::Told told_;
  NatsMessageTaken taken_;
};

}  // namespace woodlouse::server
