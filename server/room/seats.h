// Who is in a room: members with a connection, the house's own bots, and lice whose player is only in the
// recording that the game goes on from.
// Pure. The room's strand owns it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/room/channels.h"
#include "server/room/house_bots.h"
#include "server/room/start.h"
#include "server/room/subscriber.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

struct Member {
  std::shared_ptr<Subscriber> subscriber;
  std::string name;
  protocol::Role role = protocol::Role::kPlayer;
  match::PlayerId louse = 0;  ///< 0: a spectator
  ChannelId channel = 0;
  std::uint32_t first_seq =
      0;  ///< what the match adds to the member's own count: a louse taken over has used some
};

struct HouseMember {
  HouseBot bot;
  match::PlayerId louse = 0;
  std::uint32_t seq = 0;  ///< of its last input
};

struct Roster {
  std::map<SessionId, Member> members;
  std::vector<HouseMember> house;
  std::vector<Orphan> orphans;  ///< by louse

  /// The first orphan of that name, which is none any more; nothing where there is none.
  std::optional<Orphan> take_over(std::string_view name) {
    const auto found = std::find_if(orphans.begin(), orphans.end(),
                                    [name](const Orphan& orphan) { return orphan.name == name; });
    if (found == orphans.end()) return std::nullopt;
    Orphan taken = std::move(*found);
    orphans.erase(found);
    return taken;
  }

  [[nodiscard]] Member* find(SessionId session) {
    const auto found = members.find(session);
    return found == members.end() ? nullptr : &found->second;
  }

  /// Orphans and the house's bots first, then by the order of joining.
  [[nodiscard]] std::vector<protocol::PlayerEntry> entries() const {
    std::vector<protocol::PlayerEntry> entries;
    for (const Orphan& orphan : orphans) entries.push_back({orphan.louse, orphan.name, orphan.role});
    for (const HouseMember& member : house)
      entries.push_back({member.louse, member.bot.name(), protocol::Role::kBot});
    for (const auto& [session, member] : members) entries.push_back({member.louse, member.name, member.role});
    return entries;
  }
};

}  // namespace woodlouse::server
