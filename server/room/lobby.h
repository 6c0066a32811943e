// The rooms of a server, by name.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "server/room/room.h"

namespace woodlouse::server {

/// Filled before the first connection, then read by every thread. Does not own the rooms.
class Lobby {
 public:
  void add(Room& room) { rooms_.push_back(&room); }

  /// The room of that name, the first one for an empty name, or null.
  [[nodiscard]] Room* find(std::string_view name) const {
    if (name.empty()) return rooms_.empty() ? nullptr : rooms_.front();
    const auto found =
        std::find_if(rooms_.begin(), rooms_.end(), [name](Room* room) { return room->name() == name; });
    return found == rooms_.end() ? nullptr : *found;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Room* room : rooms_) names.push_back(room->name());
    return names;
  }
  [[nodiscard]] protocol::Rooms list() const {
    protocol::Rooms list;
    for (const Room* room : rooms_) list.rooms.push_back(room->census());
    return list;
  }

 private:
  std::vector<Room*> rooms_;
};

}  // namespace woodlouse::server
