#include "server/room/lobby.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace woodlouse::server {
namespace {

auto find_in(auto& rooms, std::string_view name) {
  return std::find_if(rooms.begin(), rooms.end(), [name](const auto& room) { return room->name() == name; });
}

}  // namespace

bool Lobby::open(std::shared_ptr<Room> room, std::function<void()> ended) {
  assert(room != nullptr && !room->name().empty());
  const std::lock_guard lock(mutex_);
  if (stopped_ || find_in(rooms_, room->name()) != rooms_.end()) return false;
  room->start(std::move(ended));
  rooms_.push_back(std::move(room));
  ++changes_;
  return true;
}

bool Lobby::close(std::string_view name, const protocol::Bye& bye, const std::string& reason,
                  std::function<void()> closed) {
  std::shared_ptr<Room> room;
  {
    const std::lock_guard lock(mutex_);
    const auto found = find_in(rooms_, name);
    if (stopped_ || found == rooms_.end()) return false;
    room = std::move(*found);
    rooms_.erase(found);
    closing_.push_back(room);
    ++changes_;
  }
  room->stop(bye, reason, [this, closing = room.get(), closed = std::move(closed)] {
    {
      const std::lock_guard lock(mutex_);
      std::erase_if(closing_, [closing](const auto& other) { return other.get() == closing; });
    }
    closed();
  });
  return true;
}

std::size_t Lobby::stop(const protocol::Bye& bye, const std::string& reason,
                        const std::function<void()>& stopped) {
  std::vector<std::shared_ptr<Room>> rooms;
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    rooms = rooms_;
    rooms.insert(rooms.end(), closing_.begin(), closing_.end());
  }
  for (const auto& room : rooms) room->stop(bye, reason, stopped);
  return rooms.size();
}

std::shared_ptr<Door> Lobby::find(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = name.empty() ? rooms_.begin() : find_in(rooms_, name);
  return found == rooms_.end() ? nullptr : (*found)->door();
}

std::vector<std::string> Lobby::names() const {
  std::vector<std::string> names;
  for (const auto& room : rooms()) names.push_back(room->name());
  return names;
}

protocol::Rooms Lobby::list() const {
  protocol::Rooms list;
  for (const auto& room : rooms()) list.rooms.push_back(room->census());
  return list;
}

std::string_view Lobby::why_not_ready(Time now) const {
  const std::lock_guard lock(mutex_);
  const bool is_late = std::any_of(rooms_.begin(), rooms_.end(),
                                   [now](const auto& room) { return room->next_tick().is_too_late(now); });
  return is_late ? "ticks are overdue" : "";
}

std::vector<std::shared_ptr<Room>> Lobby::rooms() const {
  const std::lock_guard lock(mutex_);
  return rooms_;
}

}  // namespace woodlouse::server
