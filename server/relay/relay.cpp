#include "server/relay/relay.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/logging/events.h"
#include "shared/core/joined.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {

Relay::Relay(boost::asio::io_context& ticks, const Lanes& lanes, RoomSettings settings,
             const LiveLimits& limits, Duration delay, Timekeeper& timekeeper,
             std::shared_ptr<spdlog::logger> log)
    : ticks_(ticks),
      lanes_(lanes),
      settings_(std::move(settings)),
      limits_(limits),
      delay_(delay),
      timekeeper_(timekeeper),
      log_(std::move(log)) {
  assert(settings_.name.empty() && settings_.state_hz >= 1);
}

std::shared_ptr<RelayRoom> Relay::make(const std::string& name) {
  RoomSettings settings = settings_;
  settings.name = name;
  RelayRoom::Hooks hooks;
  hooks.ready = [this, name] {
    const std::lock_guard lock(mutex_);
    const auto found = rooms_.find(name);
    if (found == rooms_.end() || std::exchange(found->second.is_ready, true)) return;
    ++changes_;
    log_event(*log_, LogEvent::kRoomOpened, core::joined({"room ", name, ": is shown here"}));
  };
  // Another one reads on from the next keyframe.
  hooks.lost = [this, name](const std::string& why) {
    log_event(*log_, LogEvent::kClusterDiffers, core::joined({"FOLLOWER DIFFERS: room ", name, ": ", why}));
    const std::lock_guard lock(mutex_);
    const auto found = rooms_.find(name);
    if (found == rooms_.end()) return;
    found->second.room = make(name);
    found->second.room->take({found->second.header});
    found->second.is_ready = false;
    ++changes_;
  };
  return std::make_shared<RelayRoom>(ticks_, lanes_, std::move(settings), limits_, delay_, timekeeper_, maps_,
                                     std::move(hooks));
}

void Relay::take(const std::string& room, std::vector<std::string> lines) {
  assert(!room.empty());
  const std::lock_guard lock(mutex_);
  Shown& shown = rooms_[room];
  if (shown.room == nullptr) shown.room = make(room);
  for (const std::string& line : lines)
    if (line.starts_with(R"({"format":)")) shown.header = line;
  shown.room->take(std::move(lines));
}

void Relay::close(const std::string& room) {
  const std::lock_guard lock(mutex_);
  const auto found = rooms_.find(room);
  if (found == rooms_.end()) return;
  found->second.room->close({std::string(protocol::code::kShutdown), "the room has closed", false, {}});
  rooms_.erase(found);
  ++changes_;
}

std::shared_ptr<Door> Relay::find(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = name.empty() ? std::find_if(rooms_.begin(), rooms_.end(),
                                                 [](const auto& entry) { return entry.second.is_ready; })
                                  : rooms_.find(name);
  return found == rooms_.end() || !found->second.is_ready ? nullptr : found->second.room->door();
}

std::vector<std::string> Relay::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [name, shown] : rooms_)
    if (shown.is_ready) names.push_back(name);
  return names;
}

std::string_view Relay::why_not_ready(Time) const {
  const std::lock_guard lock(mutex_);
  const bool shows =
      std::any_of(rooms_.begin(), rooms_.end(), [](const auto& entry) { return entry.second.is_ready; });
  if (!shows) return "no room is shown yet";
  return hears_() ? "" : "NATS is not connected: what is shown stands";
}

protocol::Rooms Relay::list() const {
  const std::lock_guard lock(mutex_);
  protocol::Rooms list;
  for (const auto& [name, shown] : rooms_)
    if (shown.is_ready) list.rooms.push_back(shown.room->census());
  return list;
}

}  // namespace woodlouse::server
