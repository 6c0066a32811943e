// What works beside the games of a server: recordings, boards of records, shadows, tiles built ahead. Makes
// the watchers of each game.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/thread_pool.hpp>

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/cluster/cluster.h"
#include "server/config.h"
#include "server/records/records.h"
#include "server/room/start.h"
#include "server/room/tick_watcher.h"
#include "server/watchers/recordings.h"
#include "shared/core/error.h"
#include "shared/core/team.h"

namespace woodlouse::server {

class Companions {
 public:
  /// For what of a recording is still on its way at the end: one whose disk stands still is left behind.
  static constexpr Duration kLastMoment = std::chrono::milliseconds(30);
  /// For runs that are still to be re-run and written.
  static constexpr Duration kLastRecords = std::chrono::milliseconds(150);

  explicit Companions(std::shared_ptr<spdlog::logger> log) : log_(std::move(log)) {}

  /// Before it is asked for anything else. shadow_threads: for all shadows together.
  void begin(const ServeConfig& config, std::size_t shadow_threads);

  // Any thread; these may wait for a disk:

  /// Of a game that has not begun. failed: what can't be written; it has no watcher.
  Watchers make(const std::string& room, const Start& start, std::vector<core::Error>& failed);
  /// A recording of a game that goes on, which then is recorded, and so are the room's further games. Errors:
  /// nothing is recorded here (no --record), or it can't be written.
  core::Expected<std::unique_ptr<TickWatcher>> record(const std::string& room, replay::Header header);
  /// Nor are the further games of that room.
  void do_not_record(const std::string& room);
  /// The room is closed: another one of its name is recorded as rooms are.
  void forget(const std::string& room) {
    const std::lock_guard lock(mutex_);
    unrecorded_.erase(room);
  }
  /// Further games are logged there, too; outlives it.
  void use(Cluster& cluster) { cluster_ = &cluster; }
  [[nodiscard]] bool has_recordings() const { return recordings_.has_value(); }
  /// How many recordings begin new files.
  std::size_t ask_for_next_files() { return recordings_ ? recordings_->ask_for_next_files() : 0; }

  /// None, where games are not recorded.
  [[nodiscard]] const std::optional<Recordings>& recordings() const { return recordings_; }
  /// Shares the steps of big rooms; null: each on one thread.
  [[nodiscard]] const std::shared_ptr<core::Team>& step_team() const { return step_team_; }

  // When the rooms have stopped:

  /// Waits, within bounds, for what is still to be written.
  void end();
  /// What is left of files is closed; pools of threads last as long as this.
  void drop_files();
  /// "FILE: why", of each recording that ended before its time.
  [[nodiscard]] std::vector<std::string> lost_recordings() const {
    return recordings_ ? recordings_->lost() : std::vector<std::string>();
  }
  /// "FILE: which run", of each record that is in no file.
  [[nodiscard]] std::vector<std::string> lost_records() const {
    return records_ ? records_->lost() : std::vector<std::string>();
  }

 private:
  [[nodiscard]] bool is_to_be_recorded(const std::string& room);

  const std::shared_ptr<spdlog::logger> log_;
  std::shared_ptr<core::Team> step_team_;
  std::filesystem::path dump_folder_;  ///< of shadows: beside the recording, or where the server was started
  std::mutex mutex_;
  std::set<std::string, std::less<>> unrecorded_;   ///< rooms, by their operator
  std::optional<boost::asio::thread_pool> ground_;  ///< once a map is too big for the memory
  std::optional<boost::asio::thread_pool> shadows_;
  std::optional<Recordings> recordings_;
  std::optional<Records> records_;
  Cluster* cluster_ = nullptr;  ///< null: this server is alone
};

}  // namespace woodlouse::server
