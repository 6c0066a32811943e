// All recordings of a server: how they are asked for, and what is left of them at its end.
#pragma once

#include <spdlog/logger.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/timing/clock.h"
#include "server/watchers/record_pattern.h"
#include "server/watchers/recorder.h"
#include "server/watchers/recording_files.h"
#include "shared/core/error.h"
#include "shared/replay/format.h"

namespace woodlouse::server {

struct RecordSettings {
  RecordPattern pattern;
  std::optional<std::chrono::seconds> every{};  ///< a file's length; none: one file a game
  std::optional<std::uint64_t> keep_bytes{};    ///< of all files of the pattern; none: no bound
};

/// Any thread; open() may wait for the disk, the others do not. It outlives the rooms' run.
class Recordings {
 public:
  Recordings(const RecordSettings& settings, std::shared_ptr<spdlog::logger> log);
  Recordings(const Recordings&) = delete;
  Recordings& operator=(const Recordings&) = delete;
  /// end(), without waiting.
  ~Recordings();

  /// Errors: where = the recording that can't be written.
  core::Expected<std::unique_ptr<Recorder>> open(const std::string& room, replay::Header header);
  /// Every room begins a new file at its next keyframe, one that stands still when it goes on. How many will.
  std::size_t ask_for_next_files();
  /// When the rooms have stopped, or are waited for no longer: waits until `latest` for what is still to be
  /// written. A recording that has no end then is left behind, and the log says which.
  void end(Time latest);

  /// Games that no recording could be begun for.
  [[nodiscard]] std::uint64_t not_opened() const { return not_opened_; }
  /// Old files that --record-keep has cost.
  [[nodiscard]] std::uint64_t removed() const { return files_->removed(); }

  /// "FILE: why", of each that ended before its time. After end().
  [[nodiscard]] std::vector<std::string> lost() const;

 private:
  /// Of a room; both outlive its recorder.
  struct Entry {
    std::shared_ptr<RecordingWriter> writer;
    std::shared_ptr<JobThread> thread;
  };

  const std::optional<Duration> every_;
  const std::shared_ptr<RecordingFiles> files_;
  const std::shared_ptr<spdlog::logger> log_;
  std::atomic<std::uint64_t> not_opened_{0};
  mutable std::mutex mutex_;
  std::vector<Entry> entries_;  ///< that go on, or ended before their time
};

}  // namespace woodlouse::server
