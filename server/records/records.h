// All boards of a server: a folder of files, one a course. Rooms of one course share a board.
#pragma once

#include <spdlog/logger.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/records/board.h"
#include "server/records/ghost_recorder.h"
#include "server/timing/clock.h"
#include "shared/core/error.h"
#include "shared/match/match.h"

namespace woodlouse::server {

/// One thread at a time. It outlives the rooms' run.
class Records {
 public:
  /// folder: made where it is missing.
  Records(std::filesystem::path folder, std::shared_ptr<spdlog::logger> log)
      : folder_(std::move(folder)), log_(std::move(log)) {}
  Records(const Records&) = delete;
  Records& operator=(const Records&) = delete;
  /// end(), without waiting.
  ~Records() { end(Clock::now()); }

  /// For a room whose match is a race. Errors: where = the folder or the board that can't be written.
  core::Expected<std::unique_ptr<GhostRecorder>> open(const std::string& room, const match::Match& match,
                                                      const std::string& map_file);
  /// When the rooms have stopped, or are waited for no longer: waits until `latest` for what is still to be
  /// re-run or written.
  void end(Time latest);
  /// "FILE: what could not be written", after end().
  [[nodiscard]] std::vector<std::string> lost() const;

 private:
  const std::filesystem::path folder_;
  const std::shared_ptr<spdlog::logger> log_;
  std::map<std::uint64_t, std::shared_ptr<Board>> boards_;  ///< by key
};

}  // namespace woodlouse::server
