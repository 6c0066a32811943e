#include "server/room/start.h"

#include <cstdint>
#include <map>
#include <utility>

#include "shared/protocol/messages.h"
#include "shared/protocol/text_cleaning.h"

namespace woodlouse::server {

std::vector<Seat> unclaimed_seats(const match::Match& match) {
  std::vector<Seat> seats;
  for (const match::PlayerSeq& player : match.state().players) {
    if (!match.contains(player.player)) continue;
    const match::PlayerLabel& label = match.labels().at(player.player);
    std::string name = protocol::clean_text(label.name, protocol::kMaxNameBytes);
    if (name.empty()) continue;
    seats.push_back(
        {player.player, std::move(name), label.role, player.last_seq ? *player.last_seq + 1 : 0, Nobody{}});
  }
  return seats;
}

match::MatchState counted_anew(match::MatchState state) {
  std::map<match::PlayerId, std::uint32_t> next;
  for (match::AppliedInput& input : state.waiting) input.seq = next[input.player]++;
  for (match::PlayerSeq& player : state.players) {
    const auto waiting = next.find(player.player);
    player.last_seq = waiting == next.end() ? std::nullopt : std::optional(waiting->second - 1);
  }
  return state;
}

}  // namespace woodlouse::server
