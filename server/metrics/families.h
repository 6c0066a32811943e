// Every metric there is, in one list: /metrics and docs/metrics.md (a test compares the two) are made of it.
// A name is a promise to who draws and alarms by it: never renamed, never used for something else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace woodlouse::server {

enum class MetricKind : std::uint8_t { kCounter, kGauge, kHistogram };

/// In the order of families().
enum class Family : std::uint8_t {
  kBuildInfo,
  kRoomTicks,
  kRoomTickLateness,
  kRoomTickWork,
  kRoomTickOverdue,
  kRoomClockMoves,
  kRoomAsleep,
  kRoomSleeps,
  kRoomMembers,
  kRoomFramesEncoded,
  kRoomMapReadFailures,
  kShadowTicks,
  kShadowDifferences,
  kShadowEnded,
  kRecordingFailed,
  kRecordingQueue,
  kRecordingWritten,
  kRecordingLostBytes,
  kRecordingLostTicks,
  kRecordingsNotOpened,
  kRecordingsRemoved,
  kSessions,
  kSessionEnds,
  kSentBytes,
  kSentFrames,
  kReceivedLines,
  kRefusedLines,
  kConnections,
  kConnectionsLimit,
  kConnectionsRefused,
  kWebRequests,
  kWebRefused,
  kWebSessions,
  kLogLinesLost,
  kClusterOwns,
  kClusterReady,
  kClusterDiffers,
  kClusterConnected,
  kClusterHosts,
  kClusterSequence,
  kClusterWaiting,
  kClusterUnacknowledged,
  kClusterStored,
  kClusterTakeovers,
  kClusterFenced,
  kClusterHoles,
  kProcessStart,
  kProcessCpu,
  kProcessMemory,
  kProcessDescriptors,
  kProcessDescriptorsLimit,
};
inline constexpr std::size_t kFamilyCount = 51;

struct FamilyEntry {
  std::string_view name;
  MetricKind kind;
  std::string_view labels;  ///< "room, role"; empty: one series
  std::string_view help;    ///< what it is, with its unit where its name has none
};

std::span<const FamilyEntry> families();
const FamilyEntry& entry_of(Family family);
/// "counter", "gauge", "histogram".
std::string_view to_text(MetricKind kind);

}  // namespace woodlouse::server
