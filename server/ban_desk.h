// Changes the bans and their file: on a thread of its own, one change after the other, so that no disk keeps
// anybody waiting. What could not be written is not in force either.
#pragma once

#include <spdlog/logger.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "server/access/bans.h"
#include "server/access/doorman.h"
#include "server/watchers/job_thread.h"
#include "shared/core/error.h"

namespace woodlouse::server {

/// Any thread.
class BanDesk {
 public:
  /// Edits a copy of the bans. Errors: nothing is changed.
  using Edit = std::function<core::Expected<void>(Bans&)>;
  /// Called once on the desk's thread; never, once the desk has ended.
  using Done = std::function<void(core::Expected<void>)>;

  static constexpr std::size_t kMostWaiting = 64;  ///< changes
  /// For what is still to be written at the end: a disk that stands still is left behind.
  static constexpr std::chrono::milliseconds kLastMoment{50};

  /// file: none: bans last as long as the server.
  BanDesk(std::shared_ptr<Doorman> doorman, std::optional<std::filesystem::path> file);
  BanDesk(const BanDesk&) = delete;
  BanDesk& operator=(const BanDesk&) = delete;
  ~BanDesk();

  /// The file's, before anything runs.
  core::Expected<void> read();
  /// False, and done is never called: too many wait.
  [[nodiscard]] bool change(Edit edit, Done done);
  /// The file's, as it is now, take the place of those in force.
  [[nodiscard]] bool reread(Done done);
  [[nodiscard]] bool has_file() const { return file_.has_value(); }

 private:
  struct Shared;  ///< with the thread, which may be left behind
  [[nodiscard]] bool post(std::function<core::Expected<void>()> work, Done done);

  const std::optional<std::filesystem::path> file_;
  const std::shared_ptr<Doorman> doorman_;
  const std::shared_ptr<Shared> shared_;
  JobThread thread_;
};

}  // namespace woodlouse::server
