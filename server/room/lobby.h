// The rooms of a server, by name; they open and close while it runs.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "server/room/directory.h"
#include "server/room/room.h"

namespace woodlouse::server {

/// Any thread, every function: a lock is held for a look-up. A room is in memory until it is closed, its
/// watchers are done and what it posted has run; a door that somebody still holds then refuses.
class Lobby final : public Directory {
 public:
  /// Behind the rooms that are there. Starting it is the caller's. False, and nothing done, where one has its
  /// name, or after stop().
  [[nodiscard]] bool open(std::shared_ptr<Room> room);
  /// Nobody finds the room any more, its members hear `bye`, its recording ends with `reason`; then `closed`
  /// is called, on some thread. False where there is none of that name.
  [[nodiscard]] bool close(std::string_view name, const protocol::Bye& bye, const std::string& reason,
                           std::function<void()> closed);

  /// Stops every room, which stays in the list, and opens no further one. `stopped` is called once for each,
  /// on some thread; how many that will be.
  std::size_t stop(const protocol::Bye& bye, const std::string& reason, const std::function<void()>& stopped);

  [[nodiscard]] std::shared_ptr<Door> find(std::string_view name) const override;
  [[nodiscard]] std::vector<std::string> names() const override;
  [[nodiscard]] protocol::Rooms list() const override;
  /// In the order they were opened.
  [[nodiscard]] std::vector<std::shared_ptr<Room>> rooms() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<Room>> rooms_;
  bool stopped_ = false;
};

}  // namespace woodlouse::server
