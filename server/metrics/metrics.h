// What the server tells of itself while it runs: to a Prometheus, and to people.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "server/metrics/process.h"
#include "server/room/lobby.h"
#include "server/timing/cluster_figures.h"
#include "server/timing/figures.h"
#include "server/timing/live_limits.h"
#include "server/timing/timekeeper.h"
#include "server/watchers/recordings.h"

namespace woodlouse::server {

class Scrape;

/// Any thread. Nothing is counted here: who asks gets what rooms, sessions and recordings have counted, and
/// pays for it; the rooms' own figures are those of their last whole second.
class Metrics {
 public:
  /// All outlive it.
  struct Sources {
    const Lobby& lobby;
    const TrafficMetrics& traffic;
    const LiveLimits& limits;
    const Timekeeper& timekeeper;
    const std::optional<Recordings>& recordings;
    std::function<std::uint64_t()> lost_log_lines;
    std::string_view version;
    /// Its part in a cluster; any thread. Nothing: it is in none.
    std::function<std::optional<ClusterFigures>()> cluster{};
  };
  explicit Metrics(Sources sources);

  /// In Prometheus's text format: kContentType. Every family is in families.h.
  [[nodiscard]] std::string text() const;
  static constexpr std::string_view kContentType = "text/plain; version=0.0.4; charset=utf-8";

  /// The figures that tell how it is, for people: a line for the server, one for its cluster and one a room,
  /// the last one without its end.
  [[nodiscard]] std::string status() const;

 private:
  void add_rooms(Scrape& scrape) const;
  void add_traffic(Scrape& scrape) const;
  void add_process(Scrape& scrape) const;
  [[nodiscard]] std::optional<ClusterFigures> cluster_figures() const {
    return sources_.cluster ? sources_.cluster() : std::nullopt;
  }

  const Sources sources_;
  Process process_;
};

}  // namespace woodlouse::server
