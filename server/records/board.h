// A course's boards while games go on. What is driven is re-run here, on a thread of the board's own, before
// it is taken; what is asked for is answered from what stood on the boards last, without waiting for any of
// it. A disk that fails costs no row: it stays in memory and is tried again with the next one and at the end.
#pragma once

#include <spdlog/logger.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/frames/line.h"
#include "server/records/board_file.h"
#include "server/records/board_rows.h"
#include "server/records/course.h"
#include "server/room/tick_watcher.h"
#include "server/timing/clock.h"
#include "server/watchers/job_thread.h"
#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/match/ghost_tracks.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// A run as its room saw it.
struct LiveRun {
  match::DrivenRun driven;
  std::string name;
  state::Role role = state::Role::kPlayer;
  std::uint64_t when = 0;  ///< seconds since 1970 UTC
  std::string room;        ///< for the log
  TickWatcher::Tell tell;  ///< of a new best
};

class Board {
 public:
  static constexpr std::size_t kMaxQueued = 64;  ///< runs that wait to be re-run
  /// What better runs have taken the place of is rewritten away when it is more than all else and this.
  static constexpr std::size_t kSpareBytes = 4u << 20;

  /// Rows of the file are re-run first, on its thread: one that is not as it is said to be is told and left
  /// out, in the file it stays. Errors: of BoardFile::open. Throws std::system_error where the system gives
  /// no thread.
  static core::Expected<std::shared_ptr<Board>> open(const std::filesystem::path& folder,
                                                     std::shared_ptr<const map::Map> map,
                                                     std::uint32_t tick_hz, const std::string& map_file,
                                                     std::shared_ptr<spdlog::logger> log);

  // Any thread; none waits for a re-run or the disk.

  /// False: too many wait, and it is left out; the log tells.
  bool offer(LiveRun run);
  [[nodiscard]] bool wants(protocol::Board board, std::uint64_t time) const;
  /// The answer as a line of the wire; none: there is no such row.
  [[nodiscard]] Line records(protocol::Board board) const;
  [[nodiscard]] Line ghost(protocol::Board board, std::uint32_t rank) const;

  /// No run comes any more. What waits is done, until `latest`; then nobody is told of anything again.
  void close() { thread_.close(); }
  void end(Time latest);
  /// "FILE: what could not be written", after end().
  [[nodiscard]] std::vector<std::string> lost() const;

 private:
  class Book;
  explicit Board(std::shared_ptr<Book> book);

  std::shared_ptr<Book> book_;
  JobThread thread_;
};

}  // namespace woodlouse::server
