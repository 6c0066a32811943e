// What the server measures about itself.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "server/timing/clock.h"

namespace woodlouse::server {

/// A histogram of durations from 1 us to over an hour in bounded memory: 32 buckets per power of two, so that
/// a quantile is at most 3.2 % too high. One owner, no locking.
class DurationHistogram {
 public:
  void add(Duration value);
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
  std::uint64_t count_ = 0;
  Duration max_{};
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

/// A room's own figures; its strand owns them.
struct RoomFigures {
  std::uint64_t ticks = 0;
  DurationHistogram lateness;  ///< start of a tick's work after its deadline
  DurationHistogram work;      ///< a tick's work, from its start
  std::uint64_t clock_moves = 0;
  std::uint64_t sleeps = 0;             ///< how often it stood still, as nobody was there
  std::uint64_t frames_encoded = 0;     ///< keys and deltas, once per (room, format, fields, tick)
  std::optional<GroundFigures> ground;  ///< of a big map
  std::optional<ShadowFigures> shadow;
};

/// What sessions count; any thread.
struct TrafficMetrics {
  std::atomic<std::uint64_t> frames_sent{0};  ///< keys and deltas written, once per client
  std::atomic<std::uint64_t> bytes_sent{0};
  std::atomic<std::uint64_t> lines_received{0};
};

/// `volcano: ticks 3600, lateness p50 0.06 ms p99 0.21 ms max 0.90 ms, clock moves 0, frames encoded 1200`
/// Where it stood still also `, stood still 3 times`; on a big map `, tiles built 412 (409 ahead), thrown out
/// 0, read failures 0`; with a shadow `, 3600 ticks shadowed, 0 differences`.
std::string summary(const std::string& room, const RoomFigures& metrics);

}  // namespace woodlouse::server
