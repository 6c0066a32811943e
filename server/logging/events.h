// Every event that the log tells of, in one list: what is logged bears the name of one of them, and
// docs/metrics.md shows them all (a test compares the two). The texts are for people and may change; a name
// is a promise to who looks for it: never renamed, never used for something else.
#pragma once

#include <spdlog/logger.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace woodlouse::server {

/// In the order of log_events().
enum class LogEvent : std::uint8_t {
  // The server.
  kStopping,
  kStopIncomplete,
  kReloaded,
  kReloadFailed,
  kReopened,
  kCertificateRefused,
  kOperator,
  kModerator,
  kDraining,
  kKicked,
  kBanned,
  kBanFailed,
  kUnbanned,
  kMuted,
  kLogLinesLost,
  // Rooms.
  kRoomOpened,
  kRotationOpened,
  kGameBegan,
  kGameNotWritten,
  kClockMoved,
  kRoomAsleep,
  kRoomAwake,
  kRoomPaused,
  kRoomResumed,
  kRoomClosed,
  kLouseTakenOver,
  kMapUnreadable,
  // Connections.
  kConnected,
  kJoined,
  kCameBack,
  kLeft,
  kConnectionEnded,
  kSessionEnded,
  kTlsRefused,
  kProxyHeaderRefused,
  kAcceptFailed,
  kSocketOptionsFailed,
  kCloseFailed,
  // Recordings.
  kRecordingRenamed,
  kRecordingContinued,
  kRecordingNotFollowed,
  kRecordingNoFile,
  kRecordingEnded,
  kRecordingUnfinished,
  kRecordingsRemoved,
  kChatLeftOut,
  // Shadows.
  kShadowDiffers,
  kShadowEnded,
  // Records.
  kBoardTorn,
  kBoardLinePassedOver,
  kRecordRefused,
  kRunNoRecord,
  kRunLeftOut,
  kRecordsNotWritten,
  kRecordsWrittenAgain,
  // The cluster.
  kClusterFollows,
  kClusterOwns,
  kClusterFenced,
  kClusterHole,
  kClusterDiffers,
  kClusterNotDurable,
  kClusterDurable,
  kClusterFault,
};
inline constexpr std::size_t kLogEventCount = 63;

struct LogEventEntry {
  std::string_view name;  ///< a literal
  spdlog::level::level_enum level;
  std::string_view meaning;
};

std::span<const LogEventEntry> log_events();
const LogEventEntry& entry_of(LogEvent event);

/// Logs at the event's level: as text `... info joined: TEXT`, as JSON with `"event":"joined"`.
void log_event(spdlog::logger& log, LogEvent event, const std::string& text);
/// Whether that would be logged now.
bool is_logged(const spdlog::logger& log, LogEvent event);

/// The name of the event that a message bears; empty: it bears none.
std::string_view event_of(const spdlog::details::log_msg& message);
/// For a message that comes from no logger.
spdlog::source_loc borne_by(LogEvent event);

}  // namespace woodlouse::server
