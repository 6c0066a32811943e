// The rooms that are played at other servers and shown here, by name: what the log tells of each goes to a
// relay_room.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "server/relay/relay_room.h"
#include "server/room/directory.h"
#include "server/room/lanes.h"
#include "server/room/room_settings.h"
#include "server/stream/map_shelf.h"
#include "server/timing/live_limits.h"
#include "server/timing/timekeeper.h"

namespace woodlouse::server {

/// Any thread. It outlives the run of its rooms' context.
class Relay final : public Directory {
 public:
  /// settings: of every room, but for its name. delay: from one part of a log to the next, and what their
  /// ways differ by. All outlive it.
  Relay(boost::asio::io_context& ticks, const Lanes& lanes, RoomSettings settings, const LiveLimits& limits,
        Duration delay, Timekeeper& timekeeper, std::shared_ptr<spdlog::logger> log);

  /// Whether the log is heard; any thread calls it. Before another thread asks.
  void set_hears(std::function<bool()> hears) { hears_ = std::move(hears); }

  /// What the log tells of a room next, lines without their newlines. One thread.
  void take(const std::string& room, std::vector<std::string> lines);
  /// It is over.
  void close(const std::string& room);

  [[nodiscard]] std::shared_ptr<Door> find(std::string_view name) const override;
  [[nodiscard]] std::vector<std::string> names() const override;
  [[nodiscard]] protocol::Rooms list() const override;
  [[nodiscard]] std::uint64_t changes() const override { return changes_.load(); }
  /// Before it shows a room: nothing has been read of the log yet, or there is none. And while none is heard:
  /// what it shows stands.
  [[nodiscard]] std::string_view why_not_ready(Time now) const override;

 private:
  struct Shown {
    std::shared_ptr<RelayRoom> room;
    std::string header;     ///< the newest, for one that begins anew
    bool is_ready = false;  ///< it has something to show
  };
  [[nodiscard]] std::shared_ptr<RelayRoom> make(const std::string& name);

  boost::asio::io_context& ticks_;
  const Lanes& lanes_;
  const RoomSettings settings_;
  const LiveLimits& limits_;
  const Duration delay_;
  std::function<bool()> hears_ = [] { return true; };
  Timekeeper& timekeeper_;
  const std::shared_ptr<spdlog::logger> log_;
  MapShelf maps_;
  mutable std::mutex mutex_;
  std::map<std::string, Shown, std::less<>> rooms_;
  std::atomic<std::uint64_t> changes_{0};
};

}  // namespace woodlouse::server
