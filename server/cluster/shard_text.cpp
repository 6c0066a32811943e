#include "server/cluster/shard_text.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <set>
#include <utility>

#include "shared/protocol/codes.h"
#include "shared/replay/line_writer.h"

namespace woodlouse::server {

ShardText::Room* ShardText::find(TapNumber tap) {
  const auto found = by_tap_.find(tap);
  assert(found == by_tap_.end() || found->second->tap == tap);
  return found == by_tap_.end() ? nullptr : found->second;
}

/// Where its next line goes, behind one that says whose it is.
std::string& ShardText::lines_of(const Room& room) {
  if (std::exchange(last_, &room) == &room) return lines_;
  assert(!room.name.empty());
  append_room(lines_, room.name);
  return lines_;
}

void ShardText::begin(TapNumber tap, const std::string& room, const replay::Header& header,
                      const match::MatchState& state, TickWatcher::Announce announce, Time now) {
  assert(!room.empty() && tap != 0);
  if (places_.size() >= kMostRoomsOfShard && !places_.contains(room)) {
    if (announce)
      announce({std::string(protocol::code::kNotDurable),
                "this room is one too many for the cluster's log: it would be lost with this server"});
    return;
  }
  Room& game = rooms_[room];
  by_tap_.erase(game.tap);
  game = Room();
  game.tap = tap;
  game.name = room;
  by_tap_[tap] = &game;
  game.header = header;
  game.announce = std::move(announce);
  last_ = nullptr;
  places_[room].room = room;
  if (standing_ && game.announce) game.announce(*standing_);
  tell(game, state, true, now);
}

/// A fresh writer of lines for each header: it keeps an index, which nobody reads here.
void ShardText::tell(Room& room, const match::MatchState& state, bool with_header, Time now) {
  std::string& out = lines_of(room);
  if (with_header) {
    room.lines = replay::ReplayWriter();
    replay::append_header(out, room.header);
    room.renew_at = now + renew_every_;
    room.has_header = room.has_begun = true;
  }
  room.lines.append_keyframe(out, state);
  room.has_keyframe = true;
  room.tick = state.tick;
  std::set<match::PlayerId> here;
  for (const match::PlayerSeq& player : state.players) here.insert(player.player);
  // Who has joined a room that stands still is in it with its next step.
  if (!room.resting)
    std::erase_if(room.claims, [&here](const auto& entry) { return !here.contains(entry.first); });
  for (const auto& [louse, claim] : room.claims) append_claim(out, claim);
}

void ShardText::claim(TapNumber tap, const Claim& claim) {
  Room* room = find(tap);
  if (room == nullptr) return;
  room->claims.insert_or_assign(claim.louse, claim);
  if (room->has_begun) append_claim(lines_of(*room), claim);
}

void ShardText::chat(TapNumber tap, std::uint64_t tick, match::PlayerId player, const std::string& name,
                     const std::string& text) {
  Room* room = find(tap);
  if (room != nullptr && room->has_begun) room->lines.append_chat(lines_of(*room), tick, player, name, text);
}

void ShardText::step(TapNumber tap, const RecordedStep& step) {
  Room* room = find(tap);
  if (room == nullptr || !room->has_begun) return;
  room->resting.reset();
  if (room->lines.is_quiet(step.record())) {
    std::string none;
    room->lines.append_step(none, step.record(), {});
    assert(none.empty());
  } else {
    room->lines.append_step(lines_of(*room), step.record(), step.line());
  }
  room->tick = step.record().tick + 1;
}

void ShardText::keyframe(TapNumber tap, const match::MatchState& state, bool is_anew, Time now) {
  Room* room = find(tap);
  if (room != nullptr) tell(*room, state, is_anew || !room->has_begun || now >= room->renew_at, now);
}

void ShardText::await_kept(TapNumber tap, std::function<void()> kept) {
  assert(kept);
  const Room* room = find(tap);
  if (room == nullptr || !room->has_begun) return kept();
  awaiting_.push_back(std::move(kept));
}

void ShardText::rest(TapNumber tap, match::MatchState state) {
  if (Room* room = find(tap)) room->resting = std::move(state);
}

void ShardText::close(TapNumber tap) {
  const Room* const room = find(tap);
  if (room == nullptr || keeps_rooms_) return;
  last_ = nullptr;
  const std::string name = room->name;
  append_closed(lines_, name);
  places_.erase(name);
  by_tap_.erase(tap);
  rooms_.erase(name);
}

void ShardText::renew(Time now, std::size_t most) {
  for (auto room = rooms_.begin(); room != rooms_.end() && lines_.size() < most; ++room)
    if (room->second.resting && now >= room->second.renew_at)
      tell(room->second, *room->second.resting, true, now);
}

void ShardText::lose() {
  lines_.clear();
  last_ = nullptr;
  for (const auto& kept : take_awaiting()) kept();
  for (auto& [name, room] : rooms_) room.has_begun = room.has_header = room.has_keyframe = false;
  for (auto& [name, room] : rooms_) room.renew_at = Time{};
}

void ShardText::announce(const protocol::Notice& notice, bool holds) {
  standing_ = holds ? std::optional(notice) : std::nullopt;
  for (const auto& [name, room] : rooms_)
    if (room.announce) room.announce(notice);
}

void ShardText::flush() {
  for (auto& [name, room] : rooms_) {
    std::string held;
    if (room.has_begun) room.lines.flush(held);
    if (!held.empty()) lines_of(room) += held;
  }
}

std::string ShardText::cut(std::uint64_t sequence) {
  assert(sequence > 0);
  flush();
  for (auto& [name, room] : rooms_) {
    if (!room.has_begun) continue;
    RoomPlace& place = places_[name];
    place.room = name;
    if (std::exchange(room.has_header, false)) place.header = sequence;
    if (std::exchange(room.has_keyframe, false)) place.keyframe = sequence;
    place.tick = room.tick;
  }
  last_ = nullptr;
  return std::exchange(lines_, {});
}

std::vector<RoomPlace> ShardText::places() const {
  std::vector<RoomPlace> places;
  std::transform(places_.begin(), places_.end(), std::back_inserter(places),
                 [](const auto& entry) { return entry.second; });
  return places;
}

void ShardText::keep_places(const std::set<std::string>& rooms) {
  std::erase_if(places_, [&rooms](const auto& entry) { return !rooms.contains(entry.first); });
}

void ShardText::take_over(const std::vector<RoomPlace>& places) {
  for (const RoomPlace& place : places) places_.emplace(place.room, place);
}

}  // namespace woodlouse::server
