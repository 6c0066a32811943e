// What the server measures about itself.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/timing/clock.h"
#include "server/timing/code_counts.h"

namespace woodlouse::server {

/// A histogram of durations from 1 us to over an hour in bounded memory: 32 buckets per power of two, so that
/// a quantile is at most 3.2 % too high; and, exact, how many were at most as long as each of a few bounds.
/// One owner, no locking.
class DurationHistogram {
 public:
  /// Fit for a tick's lateness and work. Ascending.
  static constexpr std::array<std::chrono::microseconds, 10> kBounds{{
      std::chrono::microseconds(100),
      std::chrono::microseconds(250),
      std::chrono::microseconds(500),
      std::chrono::microseconds(1000),
      std::chrono::microseconds(2500),
      std::chrono::microseconds(5000),
      std::chrono::microseconds(10'000),
      std::chrono::microseconds(25'000),
      std::chrono::microseconds(50'000),
      std::chrono::microseconds(100'000),
  }};

  void add(Duration value);
  /// How many were at most kBounds[bound].
  [[nodiscard]] std::uint64_t count_within(std::size_t bound) const;
  [[nodiscard]] Duration sum() const { return sum_; }
  /// The smallest bucket limit that at least the share q of the values does not exceed, q in (0, 1]; zero
  /// when empty.
  [[nodiscard]] Duration quantile(double q) const;
  [[nodiscard]] Duration max() const { return max_; }
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  static constexpr std::uint32_t kSteps = 32;
  static constexpr std::uint32_t kOctaves = 28;
  static std::size_t bucket(std::uint64_t us);
  static std::uint64_t upper_limit(std::size_t bucket);

  std::array<std::uint64_t, kSteps*(kOctaves + 1)> counts_{};
  std::array<std::uint64_t, kBounds.size() + 1> ranges_{};  ///< up to a bound and above the one before it
  std::uint64_t count_ = 0;
  Duration max_{};
  Duration sum_{};
};

/// Of a big map's tiles (terrain/tile_store.h).
struct GroundFigures {
  std::size_t live = 0;             ///< tiles in memory
  std::uint64_t built = 0;          ///< ever
  std::uint64_t ahead = 0;          ///< of them, before a louse needed them
  std::uint64_t thrown_out = 0;     ///< made room for others
  std::uint64_t read_failures = 0;  ///< reads of the map's file that failed
};

/// Of a second match that re-runs the room's (shadow.h).
struct ShadowFigures {
  std::uint64_t ticks = 0;  ///< re-run and compared
  std::uint64_t differences = 0;
  bool ended = false;  ///< before the room did
};

/// Of a room's recordings, since the room was opened (watchers/recorder.h).
struct RecordingFigures {
  std::size_t queued = 0;           ///< jobs that wait for the disk
  std::uint64_t written_bytes = 0;  ///< as they stand in the files
  std::uint64_t lost_bytes = 0;     ///< that were made and could not be written
  std::uint64_t lost_ticks = 0;     ///< that came after a recording had ended before its time
  bool failed = false;              ///< one has ended before its time
};

/// A room's own figures; its strand owns them.
struct RoomFigures {
  std::uint64_t ticks = 0;
  DurationHistogram lateness;  ///< start of a tick's work after its deadline
  DurationHistogram work;      ///< a tick's work, from its start
  std::uint64_t clock_moves = 0;
  std::uint64_t sleeps = 0;             ///< how often it stood still, as nobody was there
  bool asleep = false;                  ///< it does now
  std::uint64_t frames_encoded = 0;     ///< keys and deltas, once per (room, format, fields, tick)
  std::optional<GroundFigures> ground;  ///< of a big map
  std::optional<ShadowFigures> shadow;
  std::optional<RecordingFigures> recording;
};

/// Why nobody was let in by a connection.
enum class RefusedConnection : std::uint8_t {
  kAddressFull,  ///< its address has as many as it may have; it was told
  kServerFull,   ///< so has the server; it was told
  kDropped,      ///< past both by so many that it was not even told
  kBanned,       ///< its address is; it was told
  kNotAccepted,  ///< the system gave none: no descriptor, no memory
  kNoTls,        ///< it spoke TLS where none is spoken
};
inline constexpr std::array<std::string_view, 6> kRefusedConnections{
    "address_full", "server_full", "dropped", "banned", "not_accepted", "no_tls"};

/// What is answered to who asks by HTTP for what he does not get.
inline constexpr std::array<std::uint32_t, 10> kRefusingStatuses{400, 403, 404, 405, 413,
                                                                 426, 429, 431, 503, 505};

/// What doors and sessions count; any thread.
struct TrafficMetrics {
  using Count = std::atomic<std::uint64_t>;

  Count frames_sent{0};  ///< keys and deltas written, once per client
  Count bytes_sent{0};
  Count lines_received{0};
  CodeCounts refused_lines;  ///< answered by an error
  CodeCounts session_ends;   ///< told by a bye
  Count sessions_lost{0};    ///< ended without one: the connection broke
  Count sessions{0};         ///< open now
  Count connections{0};      ///< accepted ever
  std::array<Count, kRefusedConnections.size()> refused_connections{};
  Count web_sessions{0};  ///< of the open ones, by WebSocket
  Count web_requests{0};  ///< heads read, or refused; upgrades among them
  std::array<Count, kRefusingStatuses.size()> web_refused{};

  static void add_one(Count& count) { count.fetch_add(1, std::memory_order_relaxed); }
  void refuse(RefusedConnection why) { add_one(refused_connections.at(static_cast<std::size_t>(why))); }
  /// A request was answered with that status.
  void answer(std::uint32_t status);
};

/// `volcano: ticks 3600, lateness p50 0.06 ms p99 0.21 ms max 0.90 ms, clock moves 0, frames encoded 1200`
/// Where it stood still also `, stood still 3 times`; on a big map `, tiles built 412 (409 ahead), thrown out
/// 0, read failures 0`; with a shadow `, 3600 ticks shadowed, 0 differences`.
std::string summary(const std::string& room, const RoomFigures& metrics);

}  // namespace woodlouse::server
