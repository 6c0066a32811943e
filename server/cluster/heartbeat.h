// How the hosts of a cluster know that each other live: each tells so many times a second, and hears the
// others, by a connection and a thread of its own: a log that does not answer must not make its owner look
// dead. What operators ask of the shard's owner comes the same way.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/cluster/cluster_settings.h"
#include "server/cluster/host_table.h"
#include "server/cluster/nats_link.h"
#include "server/timing/clock.h"
#include "shared/core/error.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

class Heartbeat {
 public:
  /// A host's beats: 10 to 20 a second, as the silence wants it after which it is taken for gone: three in it
  /// at the least, mostly five.
  [[nodiscard]] static constexpr Duration every(Duration silence) {
    return std::clamp<Duration>(silence / 5, std::chrono::milliseconds(50), std::chrono::milliseconds(100));
  }
  /// An edge's, for which nobody waits.
  static constexpr Duration kEdgeEvery = std::chrono::milliseconds(500);
  /// An owner's rooms are in one beat of so many; in each, of one that has just begun; soon, when somebody is
  /// heard for the first time, though no oftener than kRoomsApart for that.
  static constexpr Duration kRoomsEvery = std::chrono::seconds(1);
  static constexpr Duration kRoomsOpen = std::chrono::seconds(3);
  static constexpr Duration kRoomsApart = std::chrono::milliseconds(200);

  /// On a thread of this or of NATS; who is called hands it on and returns.
  struct Hooks {
    std::function<std::vector<protocol::RoomEntry>()> census{};  ///< a host's rooms; none of an edge
    std::function<void()> goes{};                                ///< some host says that it goes
    std::function<void(const MoveOrder& order)> asked{};         ///< by an operator; none of an edge
  };

  /// settings: outlive it; of an edge it tells as of one.
  Heartbeat(const ClusterSettings& settings, Hooks hooks);
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;
  ~Heartbeat() { stop(); }

  /// Waits for NATS. Errors: nobody is there.
  core::Expected<void> connect();
  /// REQUIRES that it is connected.
  void start();
  /// Tells once more, and hears nothing any more.
  void stop();

  // Any thread:

  /// What is told of this host from the next beat on: change(Beat&) has it as it was told.
  template <typename Change>
  void tell(const Change& change) {
    const std::lock_guard lock(mutex_);
    change(beat_);
  }
  /// The next beat is due now.
  void soon();
  [[nodiscard]] bool owns() const {
    const std::lock_guard lock(mutex_);
    return beat_.owns;
  }
  [[nodiscard]] bool is_cut() const { return is_cut_; }  ///< from NATS
  /// Those that are heard.
  [[nodiscard]] const HostTable& hosts() const { return table_; }

 private:
  core::Expected<void> open();
  void take(bool is_edge, std::string_view bytes);
  void beat(const std::stop_token& stop);
  void tell_once();

  const ClusterSettings& settings_;
  const Hooks hooks_;
  HostTable table_;
  std::unique_ptr<NatsLink> link_;
  std::atomic<bool> is_cut_{false};     ///< from NATS
  std::atomic<bool> is_closed_{false};  ///< for good: NATS has refused this host
  std::atomic<bool> is_new_heard_{false};
  // The beating thread's:
  std::optional<Time> owns_since_;
  Time rooms_at_{};           ///< when they were told last
  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable_any now_;
  bool is_due_ = false;  ///< before its time
  Beat beat_;
  std::jthread beating_;
};

}  // namespace woodlouse::server
