// Who is in a room: members with a connection, and the house's own bots.
// Pure. The room's strand owns it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/frame_channels.h"
#include "server/house_bots.h"
#include "server/subscriber.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

struct Member {
  std::shared_ptr<Subscriber> subscriber;
  std::string name;
  protocol::Role role = protocol::Role::kPlayer;
  match::PlayerId louse = 0;  ///< 0: a spectator
  ChannelId channel = 0;
};

struct HouseMember {
  HouseBot bot;
  match::PlayerId louse = 0;
  std::uint32_t seq = 0;  ///< of its last input
};

struct Roster {
  std::map<SessionId, Member> members;
  std::vector<HouseMember> house;

  [[nodiscard]] Member* find(SessionId session) {
    const auto found = members.find(session);
    return found == members.end() ? nullptr : &found->second;
  }

  /// The house's bots first, then by the order of joining.
  [[nodiscard]] std::vector<protocol::PlayerEntry> entries() const {
    std::vector<protocol::PlayerEntry> entries;
    for (const HouseMember& member : house)
      entries.push_back({member.louse, member.bot.name(), protocol::Role::kBot});
    for (const auto& [session, member] : members) entries.push_back({member.louse, member.name, member.role});
    return entries;
  }
};

}  // namespace woodlouse::server
