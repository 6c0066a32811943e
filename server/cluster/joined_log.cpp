#include "server/cluster/joined_log.h"

#include <algorithm>
#include <cassert>
#include <variant>

#include "server/cluster/shard_view.h"
#include "shared/core/joined.h"
#include "shared/json/document.h"

namespace woodlouse::server {
namespace {

using core::joined;

/// The tick that a line says it is of, by its first member; the rest was read before.
std::optional<std::uint64_t> number_behind(std::string_view line, std::string_view begins) {
  if (!line.starts_with(begins)) return std::nullopt;
  const auto document = json::parse(line, {8, 1'000'000});
  if (!document) return std::nullopt;
  const auto value = document->root().find(begins.substr(2, begins.size() - 4));
  return value ? value->unsigned_integer() : std::nullopt;
}

std::uint64_t steps_of(std::string_view line) {
  const auto document = json::parse(line, {8, 1'000'000});
  const auto steps = document ? document->root().find("steps") : std::nullopt;
  return steps ? steps->unsigned_integer().value_or(1) : 1;
}

std::string file_part(std::string room) {
  std::replace_if(
      room.begin(), room.end(), [](char c) { return c == '/' || c == '\\' || c < ' '; }, '-');
  return room;
}

}  // namespace

core::Expected<void> JoinedLog::take(std::uint64_t sequence, const Batch& batch) {
  assert(sequence > 0);
  std::string current;
  const std::string place = joined({"batch ", std::to_string(sequence)});
  const auto lines = whole_.take(batch);
  if (!lines) return {};
  return for_each_line(*lines, [&](std::string_view text) -> core::Expected<void> {
    const auto line = read_batch_line(text, place);
    if (!line) return tl::unexpected(line.error());
    if (const auto* named = std::get_if<RoomLine>(&*line)) current = named->room;
    if (const auto* closed = std::get_if<ClosedLine>(&*line)) rooms_[closed->room].due.reset();
    if (const auto* recorded = std::get_if<RecordedLine>(&*line))
      return record(current, rooms_[current], recorded->text);
    return {};
  });
}

core::Expected<void> JoinedLog::record(const std::string& name, Room& room, std::string_view line) {
  if (line.starts_with(R"({"format":)")) {
    room.header = line;  // told again, or of the host that goes on: a keyframe says which
    return {};
  }
  if (const auto tick = number_behind(line, R"({"keyframe":)")) {
    room.has_lost = false;
    if (room.due && *tick == *room.due) {
      if (!room.has_keyframe) put(room, line);
      room.has_keyframe = true;
      return {};
    }
    if (room.due && *tick > *room.due) {
      ++holes_;
      out_ << "room " << name << ": HOLE: ticks " << *room.due << " to " << *tick << " are missing\n";
    }
    if (room.due && *tick < *room.due) {
      ++holes_;
      out_ << "room " << name << ": BEGINS ANEW at tick " << *tick << ", though tick " << *room.due
           << " was to come\n";
    }
    if (room.header.empty()) return {};  // its header is older than the log
    room.due = *tick;
    room.has_keyframe = true;
    if (auto begun = begin_file(name, room); !begun) return begun;
    put(room, room.header);
    put(room, line);
    return {};
  }
  if (!room.due || room.has_lost) return {};
  if (const auto tick = number_behind(line, R"({"step":)")) {
    room.due = *tick + steps_of(line);
    room.has_keyframe = false;
  }
  put(room, line);
  return {};
}

core::Expected<void> JoinedLog::begin_file(const std::string& name, Room& room) {
  ++room.files;
  if (folder_.empty()) return {};
  room.file = std::ofstream();
  const std::string number = room.files == 1 ? std::string() : joined({".", std::to_string(room.files)});
  room.path = folder_ / joined({file_part(name), number, ".ndjson"});
  room.file.open(room.path, std::ios::binary | std::ios::trunc);
  if (!room.file) return core::fail(room.path.string(), "can't be written", "does its folder exist?");
  out_ << "room " << name << ": " << room.path.string() << ", from tick " << *room.due << " on\n";
  return {};
}

void JoinedLog::put(Room& room, std::string_view line) {
  if (room.file.is_open()) room.file << line << '\n';
}

core::Expected<void> JoinedLog::close() {
  for (auto& [name, room] : rooms_) {
    if (room.due && room.has_lost) {
      ++holes_;
      out_ << "room " << name << ": HOLE: from tick " << *room.due << " on nothing is known\n";
    }
    if (!room.file.is_open()) continue;
    room.file.close();
    if (room.file.fail()) return core::fail(room.path.string(), "can't be written");
  }
  return {};
}

}  // namespace woodlouse::server
