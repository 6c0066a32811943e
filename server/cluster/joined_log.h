// A room's recordings, joined from a shard's log: one file as long as each step follows the one before,
// whoever's host it was played on; another where the room's game ends, or the log has a hole. Writes them
// into a folder, or only names the holes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <string_view>

#include "server/cluster/batch.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class JoinedLog {
 public:
  /// folder: empty: nothing is written; a file that is there already is left as it is, and an error. out:
  /// where holes are named.
  JoinedLog(std::filesystem::path folder, std::ostream& out) : folder_(std::move(folder)), out_(out) {}

  /// The stream's next batch, whose lines have been read by a ShardView before.
  core::Expected<void> take(std::uint64_t sequence, const Batch& batch);
  /// A batch is gone: what follows counts from each room's next keyframe on.
  void lose() {
    whole_.lose();
    for (auto& [name, room] : rooms_) room.has_lost = true;
  }
  /// All is on its way to the disk. Error: something couldn't be written.
  core::Expected<void> close();
  [[nodiscard]] std::size_t holes() const { return holes_; }

 private:
  struct Room {
    std::string header;
    std::optional<std::uint64_t> due;  ///< the step that is to come; none: no keyframe yet
    bool has_keyframe = false;         ///< of that tick
    bool has_lost = false;             ///< steps up to the next keyframe
    std::uint64_t files = 0;
    std::filesystem::path path;  ///< of the file; empty: none is written
    std::string pending;         ///< that is not in it yet: of a thousand rooms no file is held open
  };
  core::Expected<void> record(const std::string& name, Room& room, std::string_view line);
  core::Expected<void> begin_file(const std::string& name, Room& room);
  static core::Expected<void> write_pending(Room& room);
  static core::Expected<void> put(Room& room, std::string_view line);

  const std::filesystem::path folder_;
  std::ostream& out_;
  std::map<std::string, Room, std::less<>> rooms_;
  std::set<std::filesystem::path> written_;
  WholeBatches whole_;
  std::size_t holes_ = 0;
};

}  // namespace woodlouse::server
