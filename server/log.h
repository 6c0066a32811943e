// The server's log: on standard error or in a file, as text for people or one JSON object a line for
// machines. Whoever logs never waits for who reads it: a thread of its own writes, of what it does not come
// to the oldest is lost, and counted.
#pragma once

#include <spdlog/logger.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/error.h"

namespace spdlog::details {
class thread_pool;
}

namespace woodlouse::server {

enum class LogFormat : std::uint8_t { kText, kJson };

/// The names of levels, from the least severe on.
inline std::vector<std::string> log_levels() { return {"debug", "info", "warning", "error"}; }

/// Holds the log's thread. When it goes, what was logged is written, as long as that goes on: a pipe that
/// nobody has read from for kPatience must not keep a server from ending, nor one that is read slowly for
/// kLongest.
class Log {
 public:
  static constexpr std::size_t kMostWaiting = 8192;  ///< lines
  static constexpr std::chrono::milliseconds kPatience{500};
  static constexpr std::chrono::milliseconds kLongest{2000};

  explicit Log(LogFormat format);
  /// Appends to a file. Errors: it can't be opened.
  static core::Expected<std::unique_ptr<Log>> open(LogFormat format, const std::filesystem::path& file);
  /// To another sink than standard error. Nothing but the log's thread calls it.
  Log(LogFormat format, spdlog::sink_ptr sink);
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  ~Log();

  /// A file is opened anew for the next line, as it was moved away; where that fails the old one serves on.
  /// Standard error stays. Any thread.
  void reopen() const { reopen_(); }

  /// Lines that went nowhere: nobody read them in time, or they could not be written. Any thread.
  [[nodiscard]] std::uint64_t lost_lines() const;

  /// Thread safe; REQUIRES that the log lives. What is logged is an event
  /// (logging/events.h), formatted first, log_event(*log, event, fmt::format(...)), by fmt's library: the
  /// logger's own templates compile fmt again in each file that logs, five seconds each.
  [[nodiscard]] const std::shared_ptr<spdlog::logger>& logger() const { return logger_; }

 private:
  std::function<void()> reopen_ = [] {};
  spdlog::sink_ptr sink_;
  std::shared_ptr<spdlog::details::thread_pool> thread_;
  std::shared_ptr<spdlog::logger> logger_;
};

/// How a message becomes a line: whatever it holds, one of its own, and printable (core/printable.h).
std::unique_ptr<spdlog::formatter> formatter_of(LogFormat format);

/// The text as the inside of a JSON string: \uXXXX for what is not printable; bytes that are no UTF-8 become
/// '?'.
std::string json_escaped(std::string_view text);

}  // namespace woodlouse::server
