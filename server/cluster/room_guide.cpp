#include "server/cluster/room_guide.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <set>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"

namespace woodlouse::server {
namespace {

bool has_name(const std::vector<HostedRoom>& rooms, std::string_view name) {
  return std::any_of(rooms.begin(), rooms.end(), [name](const auto& one) { return one.room.name == name; });
}

}  // namespace

/// Of this host's shard they may be told by a host that does not know yet that they are here.
std::vector<HostedRoom> RoomGuide::rooms_elsewhere(const std::vector<HostedRoom>& here) const {
  if (!cluster_.rooms) return {};
  std::vector<HostedRoom> others = cluster_.rooms();
  std::erase_if(others, [&](const HostedRoom& other) {
    return other.room.address.empty() || (other.shard == cluster_.shard && has_name(here, other.room.name));
  });
  std::sort(others.begin(), others.end(), [](const HostedRoom& a, const HostedRoom& b) {
    return RoomName{a.shard, a.room.name} < RoomName{b.shard, b.room.name};
  });
  if (others.size() > kMostElsewhere) others.resize(kMostElsewhere);
  return others;
}

std::vector<HostedRoom> RoomGuide::rooms() const {
  std::vector<HostedRoom> all;
  for (protocol::RoomEntry& room : here_->list().rooms) all.push_back({cluster_.shard, std::move(room)});
  std::vector<HostedRoom> others = rooms_elsewhere(all);
  std::move(others.begin(), others.end(), std::back_inserter(all));
  std::vector<RoomName> names;
  std::transform(all.begin(), all.end(), std::back_inserter(names), [](const HostedRoom& one) {
    return RoomName{one.shard, one.room.name};
  });
  const std::vector<std::string> codes = join_codes(cluster_.name, names);
  assert(codes.size() == all.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k].room.code = codes[k];
  return all;
}

std::optional<HostedRoom> RoomGuide::called(std::string_view name) const {
  std::vector<HostedRoom> all = rooms();
  auto found =
      std::find_if(all.begin(), all.end(), [name](const auto& one) { return one.room.name == name; });
  const auto code = typed_join_code(name);
  if (found == all.end() && code)
    found = std::find_if(all.begin(), all.end(), [&code](const auto& one) { return one.room.code == *code; });
  return found == all.end() ? std::nullopt : std::optional(std::move(*found));
}

std::shared_ptr<Door> RoomGuide::find(std::string_view name) const {
  if (auto door = here_->find(name)) return door;
  if (!typed_join_code(name)) return nullptr;
  const auto room = called(name);
  return room && room->room.address.empty() ? here_->find(room->room.name) : nullptr;
}

std::optional<std::string> RoomGuide::elsewhere(std::string_view name) const {
  if (!cluster_.where) return std::nullopt;
  if (auto address = cluster_.where(name)) return address;
  const auto room = called(name);
  if (!room || room->room.address.empty()) return std::nullopt;
  // Of this shard it is known better than by the last word of its owner.
  return room->shard == cluster_.shard ? cluster_.where(room->room.name) : room->room.address;
}

std::vector<std::string> RoomGuide::names() const {
  std::vector<std::string> names = here_->names();
  if (!cluster_.rooms) return names;
  std::set<std::string> told(names.begin(), names.end());
  for (const HostedRoom& one : rooms())
    if (told.insert(one.room.name).second) names.push_back(one.room.name);
  return names;
}

protocol::Rooms RoomGuide::list() const {
  protocol::Rooms list;
  for (HostedRoom& one : rooms()) list.rooms.push_back(std::move(one.room));
  return list;
}

std::uint64_t RoomGuide::changes() const {
  if (!cluster_.rooms) return here_->changes();
  std::string text = std::to_string(here_->changes());
  for (const HostedRoom& one : rooms())
    if (!one.room.address.empty())
      text += core::joined({"\n", one.shard, "\n", one.room.name, "\n", one.room.address});
  return core::stable_hash(text);
}

}  // namespace woodlouse::server
