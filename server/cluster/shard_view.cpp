#include "server/cluster/shard_view.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <set>
#include <utility>
#include <variant>

#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

using core::joined;

std::string place_of(std::uint64_t sequence) { return joined({"batch ", std::to_string(sequence)}); }

bool is_header(std::string_view line) { return line.starts_with(R"({"format":)"); }
bool is_keyframe(std::string_view line) { return line.starts_with(R"({"keyframe":)"); }

}  // namespace

ShardView::Beginning ShardView::beginning(const LastBatch& last) {
  Beginning beginning;
  beginning.from = last.sequence - std::min<std::uint64_t>(last.head.part, last.sequence - 1);
  for (const RoomPlace& place : last.head.rooms)
    if (place.keyframe != 0) beginning.from = std::min(beginning.from, place.keyframe);
  for (const RoomPlace& place : last.head.rooms)
    if (place.header != 0 && place.header < beginning.from)
      beginning.headers[place.header].insert(place.room);
  return beginning;
}

core::Expected<void> ShardView::take_headers(const RoomNames& rooms, std::string_view lines,
                                             const std::string& place) {
  std::string current;
  RoomNames missing = rooms;
  const auto visit = [&](std::string_view text) -> core::Expected<void> {
    const auto line = read_batch_line(text, place);
    if (!line) return tl::unexpected(line.error());
    if (const auto* named = std::get_if<RoomLine>(&*line)) current = named->room;
    const auto* recorded = std::get_if<RecordedLine>(&*line);
    if (recorded == nullptr || !rooms.contains(current) || !is_header(recorded->text)) return {};
    record(current, rooms_[current], recorded->text);
    missing.erase(current);
    return {};
  };
  if (auto read = for_each_line(lines, visit); !read) return read;
  if (!missing.empty()) return core::fail(place, joined({"has no header of room ", *missing.begin()}));
  return {};
}

core::Expected<void> ShardView::check_order(std::uint64_t sequence, const BatchHead& head) const {
  if (!head_) return {};
  const std::string place = place_of(sequence);
  if (sequence != sequence_ + 1)
    return core::fail(place, joined({"comes behind batch ", std::to_string(sequence_)}));
  if (head.writer == head_->writer) {
    if (head.number == head_->number + 1 || (is_behind_gap_ && head.number > head_->number)) return {};
    return core::fail(place, joined({"is number ", std::to_string(head.number), " of its writer, behind ",
                                     std::to_string(head_->number)}));
  }
  if ((head.number == 0 || is_behind_gap_) && head.writer.epoch > head_->writer.epoch) return {};
  return core::fail(
      place, joined({"is of epoch ", std::to_string(head.writer.epoch), " of ", head.writer.host,
                     ", behind epoch ", std::to_string(head_->writer.epoch), " of ", head_->writer.host}));
}

core::Expected<void> ShardView::take(std::uint64_t sequence, const Batch& batch) {
  assert(sequence > 0);
  if (batch.head.behavior != match::kBehavior)
    return core::fail(place_of(sequence),
                      joined({"is of behavior ", std::to_string(batch.head.behavior), ", this build's is ",
                              std::to_string(match::kBehavior)}),
                      "hosts of one cluster have the same version");
  if (auto order = check_order(sequence, batch.head); !order) return order;
  head_ = batch.head;
  is_behind_gap_ = false;
  sequence_ = sequence;
  const auto lines = whole_.take(batch);
  if (!lines) return {};
  current_.clear();
  const std::string place = place_of(sequence);
  return for_each_line(*lines, [&](std::string_view text) -> core::Expected<void> {
    auto line = read_batch_line(text, place);
    if (!line) return tl::unexpected(line.error());
    return take_line(*line);
  });
}

void ShardView::lose(std::uint64_t sequence) {
  assert(sequence_ == 0 || sequence == sequence_ + 1);
  sequence_ = sequence;
  is_behind_gap_ = true;
  whole_.lose();
  for (auto& [name, room] : rooms_) room.stands_still = true;
}

bool ShardView::has_gap() const {
  return std::any_of(rooms_.begin(), rooms_.end(),
                     [](const auto& entry) { return entry.second.stands_still; });
}

bool ShardView::lacks_rooms() const {
  return head_ && std::any_of(head_->rooms.begin(), head_->rooms.end(),
                              [this](const RoomPlace& place) { return !rooms_.contains(place.room); });
}

core::Expected<void> ShardView::take_line(const BatchLine& line) {
  if (const auto* named = std::get_if<RoomLine>(&line)) {
    current_ = named->room;
    if (rooms_.contains(current_) || rooms_.size() < kMostRoomsOfShard) return {};
    return core::fail(place_of(sequence_),
                      joined({"a shard has at most ", std::to_string(kMostRoomsOfShard), " rooms"}));
  }
  if (const auto* closed = std::get_if<ClosedLine>(&line)) {
    if (rooms_.erase(closed->room) != 0 && reader_) reader_->closed(closed->room);
    if (current_ == closed->room) current_.clear();
    return {};
  }
  if (current_.empty()) return core::fail(place_of(sequence_), "a line stands before any room's name");
  if (const auto* claim = std::get_if<Claim>(&line)) {
    const auto room = rooms_.find(current_);
    if (room != rooms_.end()) room->second.claims.insert_or_assign(claim->louse, *claim);
    return {};
  }
  const std::string_view text = std::get<RecordedLine>(line).text;
  // Lines before the first header are of a game whose beginning was not read.
  if (!rooms_.contains(current_) && !is_header(text)) return {};
  record(current_, rooms_[current_], text);
  return {};
}

void ShardView::pass_on(const std::string& name, Room& room, std::string_view line) {
  assert(reader_ && room.follower == nullptr);
  if (is_header(line)) {
    if (room.header == line) return;
    room.header = line;
  }
  reader_->line(name, line);
}

void ShardView::record(const std::string& name, Room& room, std::string_view line) {
  if (reader_) return pass_on(name, room, line);
  if (is_header(line)) {
    // Told again for who comes now.
    if (room.header == line && room.follower->match() != nullptr) return;
    room.header = line;
    room.follower = std::make_unique<follow::Follower>("the log", nullptr, maps_.get());
    room.claims.clear();
  }
  room.stands_still = room.stands_still && !is_header(line) && !is_keyframe(line);
  if (room.stands_still) return;
  assert(room.follower != nullptr);
  if (is_header(line) || is_keyframe(line) || room.follower->match() != nullptr) room.follower->take(line);
  if (const auto& found = room.follower->difference(); found && difference_.empty())
    difference_ = joined({"room ", name, ": tick ", std::to_string(found->tick), ": ", found->what});
  const match::Match* match = room.follower->match();
  if (!is_keyframe(line) || match == nullptr) return;
  std::set<match::PlayerId> here;
  for (const match::PlayerSeq& player : match->state().players) here.insert(player.player);
  std::erase_if(room.claims, [&here](const auto& entry) { return !here.contains(entry.first); });
}

std::uint64_t ShardView::proven() const {
  return std::accumulate(
      rooms_.begin(), rooms_.end(), std::uint64_t{0}, [](std::uint64_t sum, const auto& entry) {
        return entry.second.follower == nullptr ? sum : sum + entry.second.follower->proven();
      });
}

}  // namespace woodlouse::server
