// The rooms of a server, by name; they open and close while it runs.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "server/room/directory.h"
#include "server/room/room.h"

namespace woodlouse::server {

/// Any thread, every function: a lock is held for a look-up. It outlives the run of its rooms' context. A
/// room is in memory until it is closed, its watchers are done and what it posted has run; a door that
/// somebody still holds then refuses.
class Lobby final : public Directory {
 public:
  /// Starts the room, then puts it behind those that are there: who finds it finds it started. ended:
  /// Room::start()'s. False, and nothing done, where one has its name, or after stop().
  [[nodiscard]] bool open(std::shared_ptr<Room> room, std::function<void()> ended);
  /// Nobody finds the room any more, its members hear `bye`, its recording ends with `reason`; then `closed`
  /// is called, on the room's strand. False where there is none of that name, or after stop().
  [[nodiscard]] bool close(std::string_view name, const protocol::Bye& bye, const std::string& reason,
                           std::function<void()> closed);
  /// Stops every room, which stays in the list, and opens no further one. `stopped` is called once for each,
  /// those that are still closing among them; how many that will be.
  std::size_t stop(const protocol::Bye& bye, const std::string& reason, const std::function<void()>& stopped);

  [[nodiscard]] std::shared_ptr<Door> find(std::string_view name) const override;
  [[nodiscard]] std::vector<std::string> names() const override;
  [[nodiscard]] protocol::Rooms list() const override;
  [[nodiscard]] std::uint64_t changes() const override { return changes_.load(); }
  /// Where the next tick of a room has been due for longer than passes by itself (timing/next_tick.h).
  [[nodiscard]] std::string_view why_not_ready(Time now) const override;
  /// In the order they were opened.
  [[nodiscard]] std::vector<std::shared_ptr<Room>> rooms() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<Room>> rooms_;
  std::vector<std::shared_ptr<Room>> closing_;  ///< found by nobody, not at their end yet
  std::atomic<std::uint64_t> changes_{0};
  bool stopped_ = false;
};

}  // namespace woodlouse::server
