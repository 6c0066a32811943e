// What a node tells of itself to who measures it. Any thread, under its lock.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "server/cluster/host_table.h"
#include "server/cluster/log_writer.h"
#include "server/logging/events.h"
#include "server/timing/cluster_figures.h"

namespace woodlouse::server {

class NodeFigures {
 public:
  /// What the log is told of is counted.
  void count(LogEvent event);
  /// It follows the log. differs: what is re-run is not what it says.
  void follow(bool is_ready, bool differs, std::uint64_t sequence);
  /// It owns it, by that writer.
  void own(const LogWriter& writer, Time now);
  /// hosts: the others that are heard.
  [[nodiscard]] ClusterFigures figures(const std::vector<Beat>& hosts, Time now) const;

 private:
  mutable std::mutex mutex_;
  ClusterFigures told_;
  Time unacknowledged_since_{};  ///< Time{}: nothing waits
  Writer writer_;                ///< whose batches are counted
  std::uint64_t counted_ = 0;    ///< of them
};

}  // namespace woodlouse::server
