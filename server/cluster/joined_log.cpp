#include "server/cluster/joined_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>
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

/// By errno.
core::Expected<void> cant_write(const std::filesystem::path& path) {
  return core::fail(path.string(), joined({"can't be written: ", std::generic_category().message(errno)}),
                    "does its folder exist, and has it room?");
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
      return std::exchange(room.has_keyframe, true) ? core::Expected<void>() : put(room, line);
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
    auto told = put(room, room.header);
    return told ? put(room, line) : told;
  }
  if (!room.due || room.has_lost) return {};
  if (const auto tick = number_behind(line, R"({"step":)")) {
    room.due = *tick + steps_of(line);
    room.has_keyframe = false;
  }
  return put(room, line);
}

core::Expected<void> JoinedLog::begin_file(const std::string& name, Room& room) {
  if (folder_.empty()) return {};
  if (auto written = write_pending(room); !written) return written;
  // Two rooms may have names of which the same becomes.
  do {
    ++room.files;
    const std::string number = room.files == 1 ? std::string() : joined({".", std::to_string(room.files)});
    room.path = folder_ / joined({file_part(name), number, ".ndjson"});
  } while (!written_.insert(room.path).second);
  const int made = ::open(room.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0 && errno == EEXIST)
    return core::fail(room.path.string(), "is there already",
                      "another run's files are not written over: name an empty folder");
  if (made < 0) return cant_write(room.path);
  ::close(made);
  out_ << "room " << name << ": " << room.path.string() << ", from tick " << *room.due << " on\n";
  return {};
}

core::Expected<void> JoinedLog::write_pending(Room& room) {
  if (room.pending.empty()) return {};
  assert(!room.path.empty());
  std::ofstream file(room.path, std::ios::binary | std::ios::app);
  file << std::exchange(room.pending, {});
  file.close();
  return file.fail() ? cant_write(room.path) : core::Expected<void>();
}

core::Expected<void> JoinedLog::put(Room& room, std::string_view line) {
  constexpr std::size_t kMost = std::size_t{64} << 10;
  if (room.path.empty()) return {};
  room.pending.append(line).push_back('\n');
  return room.pending.size() < kMost ? core::Expected<void>() : write_pending(room);
}

core::Expected<void> JoinedLog::close() {
  for (auto& [name, room] : rooms_) {
    if (room.due && room.has_lost) {
      ++holes_;
      out_ << "room " << name << ": HOLE: from tick " << *room.due << " on nothing is known\n";
    }
    if (auto written = write_pending(room); !written) return written;
  }
  return {};
}

}  // namespace woodlouse::server
