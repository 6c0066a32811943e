// What recordings are called: a name with fields for the time and the room.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::server {

/// A room's name as a part of a file's: without what separates there.
std::string file_part(std::string room);

class RecordPattern {
 public:
  /// Of a name: {room}, once, and %Y %y %m %d %H %M %S %j %F %G %V %u as strftime has them, UTC, %% a
  /// percent sign; in its folder %% alone. A folder (that is there, or ends in /) stands for
  /// FOLDER/{room}-%Y%m%dT%H%M%SZ.ndjson.zst. A name that ends in neither .ndjson nor .zst gets
  /// .ndjson.zst, but that of a pipe or a device. rooms: of several, each has a file by room, whether
  /// {room} stands there or not; and of one map's a room of play (volcano/race) by its mode:
  /// game.race.ndjson. Errors: where = `text`, what can't stand in it, what to write instead.
  static core::Expected<RecordPattern> parse(const std::string& text, std::size_t rooms);

  /// time: seconds since 1970.
  [[nodiscard]] std::filesystem::path file(const std::string& room, std::int64_t time) const;
  /// Whether a file of that name, in its folder, can be one of some room, some time and some number
  /// (core/sink_file.h).
  [[nodiscard]] bool matches(const std::string& name) const;

  /// Where they lie: empty where the server was started. It need not be there.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  friend bool operator==(const RecordPattern&, const RecordPattern&) = default;

 private:
  /// It has no {room}: a map's rooms of play (volcano/race) have files by their mode (game.race.ndjson).
  [[nodiscard]] bool has_modes_apart() const;
  [[nodiscard]] static bool matches(const std::string& pattern, const std::string& name);
  RecordPattern(std::filesystem::path folder, std::string name);

  std::filesystem::path folder_;
  std::string name_;  ///< with its fields
};

}  // namespace woodlouse::server
