#include "server/cluster/node_figures.h"

#include <algorithm>
#include <cassert>

namespace woodlouse::server {

void NodeFigures::count(LogEvent event) {
  const std::lock_guard lock(mutex_);
  if (event == LogEvent::kClusterOwns) ++told_.takeovers;
  if (event == LogEvent::kClusterFenced) ++told_.fenced;
  if (event == LogEvent::kClusterHole) ++told_.holes;
}

void NodeFigures::follow(bool is_ready, bool differs, std::uint64_t sequence) {
  assert(!is_ready || !differs);
  const std::lock_guard lock(mutex_);
  told_.owns = false;
  told_.ready = is_ready;
  told_.differs = differs;
  told_.sequence = sequence;
  told_.waiting = 0;
  unacknowledged_since_ = Time{};
}

void NodeFigures::own(const LogWriter& writer, Time now) {
  const std::lock_guard lock(mutex_);
  told_.owns = true;
  told_.ready = told_.differs = false;
  told_.sequence = writer.next_sequence() - 1 - writer.waiting();
  told_.waiting = writer.waiting();
  const Duration silence = writer.silence(now);
  unacknowledged_since_ = silence > Duration{} ? now - silence : Time{};
  if (!(writer.writer() == writer_)) counted_ = 0;
  writer_ = writer.writer();
  // A stream that has gone back takes some once more.
  if (writer.acked() > counted_) told_.stored += writer.acked() - counted_;
  counted_ = std::max(counted_, writer.acked());
}

ClusterFigures NodeFigures::figures(const std::vector<Beat>& hosts, Time now) const {
  const std::lock_guard lock(mutex_);
  ClusterFigures figures = told_;
  if (unacknowledged_since_ != Time{})
    figures.unacknowledged = std::max(Duration{}, now - unacknowledged_since_);
  for (const Beat& beat : hosts)
    ++(beat.owns ? figures.owners : beat.ready ? figures.standing_by : figures.others);
  return figures;
}

}  // namespace woodlouse::server
