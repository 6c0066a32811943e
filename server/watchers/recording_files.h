// The files of all recordings of a server: how they are called, which are being written, and how many bytes
// they have together, of which the oldest go where that is bounded.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/watchers/record_pattern.h"
#include "shared/core/error.h"
#include "shared/core/sink_file.h"

namespace woodlouse::server {

/// Any thread. What looks at the folder does so on the caller's, who may wait for the disk; nobody else does.
class RecordingFiles {
 public:
  /// keep: bytes that the recordings which the pattern can have made may have together.
  explicit RecordingFiles(RecordPattern pattern, std::optional<std::uint64_t> keep = {});

  /// What one for the room would be called now, where none of that name is there.
  [[nodiscard]] std::filesystem::path file(const std::string& room) const;
  /// A new file for the room, named by the present time, numbered where one is there. It counts as being
  /// written until closed(). Errors: where = the file, what = the system's words.
  core::Expected<core::NewFile> create(const std::string& room);
  void closed(const std::filesystem::path& file);

  /// What make_room() did.
  struct Removed {
    std::uint64_t files = 0;
    std::uint64_t bytes = 0;
    std::string last;  ///< the newest of them
    bool fits = true;  ///< false: nothing is left to remove, and of those being written `file` is the largest
  };
  /// Before `bytes` more are written into `file`, which is being written: the oldest finished recordings that
  /// the pattern can have made go until there is room for them. No other file does: none that is no
  /// recording, and none that is being written, by whomever.
  Removed make_room(const std::filesystem::path& file, std::uint64_t bytes);

  [[nodiscard]] std::uint64_t removed() const { return removed_; }
  [[nodiscard]] std::optional<std::uint64_t> keep() const { return keep_; }

 private:
  struct Finished {
    std::filesystem::path path;
    std::filesystem::file_time_type written;
    std::uint64_t bytes = 0;
  };
  [[nodiscard]] std::vector<Finished> finished_ones();
  [[nodiscard]] bool is_recording(const std::filesystem::path& file);
  [[nodiscard]] bool is_open(const std::filesystem::path& file) const;
  [[nodiscard]] std::uint64_t open_bytes() const;

  const RecordPattern pattern_;
  const std::optional<std::uint64_t> keep_;
  std::atomic<std::uint64_t> removed_{0};
  mutable std::mutex mutex_;  ///< held for a look-up
  std::map<std::filesystem::path, std::uint64_t> open_;
  std::uint64_t closings_ = 0;
  std::optional<std::uint64_t>
      finished_bytes_;  ///< by the last look at the folder; none was, since a closing
  std::mutex looking_;  ///< who looks at the folder; nobody waits for it
  std::map<std::filesystem::path, bool> known_;  ///< of finished files: whether they are recordings
};

}  // namespace woodlouse::server
