#include "server/metrics/metrics.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "server/metrics/families.h"
#include "server/metrics/scrape.h"
#include "shared/core/printable.h"
#include "shared/match/match.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {
namespace {

double as_seconds(Duration duration) { return std::chrono::duration<double>(duration).count(); }
double as_milliseconds(Duration duration) { return 1e3 * as_seconds(duration); }

std::uint64_t value(const TrafficMetrics::Count& count) { return count.load(std::memory_order_relaxed); }

bool is_carried_by(const protocol::CodeEntry& code, std::string_view message) {
  return code.messages.find(message) != std::string_view::npos;
}

/// Names as they are shown, no two of them alike: two series of one name spoil all.
class ShownNames {
 public:
  std::string show(std::string_view name) {
    const std::string plain = core::printable(name);
    std::string shown = plain;
    for (int number = 2; !taken_.insert(shown).second; ++number) shown = fmt::format("{}-{}", plain, number);
    return shown;
  }

 private:
  std::set<std::string> taken_;
};

void add_game(Scrape& scrape, std::string_view name, const RoomFigures& figures) {
  scrape.add(Family::kRoomTicks, figures.ticks, name);
  scrape.add(Family::kRoomTickLateness, figures.lateness, name);
  scrape.add(Family::kRoomTickWork, figures.work, name);
  scrape.add(Family::kRoomClockMoves, figures.clock_moves, name);
  scrape.add(Family::kRoomSleeps, figures.sleeps, name);
  scrape.add(Family::kRoomFramesEncoded, figures.frames_encoded, name);
  if (figures.ground) scrape.add(Family::kRoomMapReadFailures, figures.ground->read_failures, name);
}

void add_watchers(Scrape& scrape, std::string_view name, const RoomFigures& figures) {
  if (const auto& shadow = figures.shadow) {
    scrape.add(Family::kShadowTicks, shadow->ticks, name);
    scrape.add(Family::kShadowDifferences, shadow->differences, name);
    scrape.add(Family::kShadowEnded, shadow->ended ? 1.0 : 0.0, name);
  }
  if (const auto& recording = figures.recording) {
    scrape.add(Family::kRecordingFailed, recording->failed ? 1.0 : 0.0, name);
    scrape.add(Family::kRecordingQueue, static_cast<double>(recording->queued), name);
    scrape.add(Family::kRecordingWritten, recording->written_bytes, name);
    scrape.add(Family::kRecordingLostBytes, recording->lost_bytes, name);
    scrape.add(Family::kRecordingLostTicks, recording->lost_ticks, name);
  }
}

/// Of a room that stands still they are those of the last time that somebody asked, or of the one before.
std::shared_ptr<const RoomFigures> fresh_figures(Room& room) {
  auto figures = room.figures();
  if (figures->asleep) room.refresh_figures();
  return figures;
}

std::string status_of(Room& room) {
  const std::shared_ptr<const RoomFigures> figures = fresh_figures(room);
  const protocol::RoomEntry census = room.census();
  std::string line = fmt::format(
      "{}: players {}, bots {}, spectators {}; ticks {}, lateness p99 {:.3f} ms, work p99 {:.3f} ms, clock "
      "moves {}",
      core::printable(room.name()), census.players, census.bots, census.spectators, figures->ticks,
      as_milliseconds(figures->lateness.quantile(0.99)), as_milliseconds(figures->work.quantile(0.99)),
      figures->clock_moves);
  if (figures->asleep) line += "; stands still";
  if (const auto& recording = figures->recording)
    line += recording->failed ? fmt::format("; RECORDING FAILED: {} ticks are in none", recording->lost_ticks)
                              : fmt::format("; recorded {} bytes, {} jobs wait", recording->written_bytes,
                                            recording->queued);
  if (const auto& shadow = figures->shadow)
    line += fmt::format("; shadowed {} ticks{}, {} differences", shadow->ticks,
                        shadow->ended ? " until it was ended" : "", shadow->differences);
  return line;
}

void add_cluster(Scrape& scrape, const ClusterFigures& cluster) {
  const auto flag = [](bool is) { return is ? 1.0 : 0.0; };
  scrape.add(Family::kClusterOwns, flag(cluster.owns));
  scrape.add(Family::kClusterReady, flag(cluster.ready));
  scrape.add(Family::kClusterDiffers, flag(cluster.differs));
  scrape.add(Family::kClusterConnected, flag(cluster.connected));
  scrape.add(Family::kClusterHosts, static_cast<double>(cluster.owners), "owns");
  scrape.add(Family::kClusterHosts, static_cast<double>(cluster.standing_by), "stands_by");
  scrape.add(Family::kClusterHosts, static_cast<double>(cluster.others), "other");
  scrape.add(Family::kClusterSequence, cluster.sequence);
  scrape.add(Family::kClusterWaiting, cluster.waiting);
  scrape.add(Family::kClusterUnacknowledged, as_seconds(cluster.unacknowledged));
  scrape.add(Family::kClusterStored, cluster.stored);
  scrape.add(Family::kClusterTakeovers, cluster.takeovers);
  scrape.add(Family::kClusterFenced, cluster.fenced);
  scrape.add(Family::kClusterHoles, cluster.holes);
}

std::string status_of(const ClusterFigures& cluster) {
  std::string line = fmt::format("cluster: shard {}: ", cluster.shard);
  if (cluster.owns)
    line += fmt::format("owns its rooms, stored up to batch {}, {} wait", cluster.sequence, cluster.waiting);
  else
    line += fmt::format("{}, has read up to batch {}", cluster.ready ? "stands by" : "CAN'T TAKE OVER",
                        cluster.sequence);
  if (cluster.unacknowledged > std::chrono::seconds(1))
    line += fmt::format("; NOTHING STORED for {:.1f} s", as_seconds(cluster.unacknowledged));
  line += fmt::format("; other hosts: {} own, {} stand by, {} can't; takeovers {}, fenced {}, holes {}",
                      cluster.owners, cluster.standing_by, cluster.others, cluster.takeovers, cluster.fenced,
                      cluster.holes);
  if (cluster.differs) line += "; FOLLOWER DIFFERS";
  if (!cluster.connected) line += "; NATS IS NOT CONNECTED";
  return line;
}

}  // namespace

Metrics::Metrics(Sources sources) : sources_(std::move(sources)) { assert(sources_.lost_log_lines); }

std::string Metrics::text() const {
  Scrape scrape;
  scrape.add(Family::kBuildInfo, 1.0, sources_.version, std::to_string(match::kBehavior),
             std::to_string(protocol::kProtocolVersion));
  add_rooms(scrape);
  add_traffic(scrape);
  if (const auto cluster = cluster_figures()) add_cluster(scrape, *cluster);
  add_process(scrape);
  return scrape.text();
}

void Metrics::add_rooms(Scrape& scrape) const {
  ShownNames names;
  for (const std::shared_ptr<Room>& room : sources_.lobby.rooms()) {
    const std::string name = names.show(room->name());
    const std::shared_ptr<const RoomFigures> figures = fresh_figures(*room);
    add_game(scrape, name, *figures);
    add_watchers(scrape, name, *figures);
    scrape.add(Family::kRoomTickOverdue, as_seconds(room->next_tick().overdue(sources_.timekeeper.now())),
               name);
    scrape.add(Family::kRoomAsleep, figures->asleep ? 1.0 : 0.0, name);
    const protocol::RoomEntry census = room->census();
    scrape.add(Family::kRoomMembers, std::uint64_t{census.players}, name, "player");
    scrape.add(Family::kRoomMembers, std::uint64_t{census.bots}, name, "bot");
    scrape.add(Family::kRoomMembers, std::uint64_t{census.spectators}, name, "spectator");
  }
  if (const auto& recordings = sources_.recordings) {
    scrape.add(Family::kRecordingsNotOpened, recordings->not_opened());
    scrape.add(Family::kRecordingsRemoved, recordings->removed());
  }
}

void Metrics::add_traffic(Scrape& scrape) const {
  const TrafficMetrics& traffic = sources_.traffic;
  scrape.add(Family::kSessions, value(traffic.sessions));
  scrape.add(Family::kSentBytes, value(traffic.bytes_sent));
  scrape.add(Family::kSentFrames, value(traffic.frames_sent));
  scrape.add(Family::kReceivedLines, value(traffic.lines_received));
  const auto codes = protocol::codes();
  for (std::size_t k = 0; k < codes.size(); ++k) {
    const std::uint64_t refused = traffic.refused_lines.count(k), ended = traffic.session_ends.count(k);
    if (refused > 0 || is_carried_by(codes[k], "error"))
      scrape.add(Family::kRefusedLines, refused, codes[k].code);
    if (ended > 0 || is_carried_by(codes[k], "bye")) scrape.add(Family::kSessionEnds, ended, codes[k].code);
  }
  scrape.add(Family::kSessionEnds, value(traffic.sessions_lost), "lost");
  scrape.add(Family::kConnections, value(traffic.connections));
  scrape.add(Family::kConnectionsLimit, std::uint64_t{sources_.limits.now()->max_connections});
  for (std::size_t k = 0; k < kRefusedConnections.size(); ++k)
    scrape.add(Family::kConnectionsRefused, value(traffic.refused_connections[k]), kRefusedConnections[k]);
  scrape.add(Family::kWebSessions, value(traffic.web_sessions));
  scrape.add(Family::kWebRequests, value(traffic.web_requests));
  for (std::size_t k = 0; k < kRefusingStatuses.size(); ++k)
    scrape.add(Family::kWebRefused, value(traffic.web_refused[k]), std::to_string(kRefusingStatuses[k]));
}

void Metrics::add_process(Scrape& scrape) const {
  scrape.add(Family::kLogLinesLost, sources_.lost_log_lines());
  const ProcessFigures process = process_.figures();
  scrape.add(Family::kProcessStart, process.start_s);
  scrape.add(Family::kProcessCpu, process.cpu_s);
  if (process.resident_bytes) scrape.add(Family::kProcessMemory, *process.resident_bytes);
  if (process.open_descriptors) scrape.add(Family::kProcessDescriptors, *process.open_descriptors);
  if (process.max_descriptors) scrape.add(Family::kProcessDescriptorsLimit, *process.max_descriptors);
}

std::string Metrics::status() const {
  const TrafficMetrics& traffic = sources_.traffic;
  const ProcessFigures process = process_.figures();
  std::string text = fmt::format(
      "{} sessions ({} by WebSocket), {:.1f} MB resident, {} of {} descriptors, {} lines of the log lost",
      value(traffic.sessions), value(traffic.web_sessions),
      1e-6 * static_cast<double>(process.resident_bytes.value_or(0)), process.open_descriptors.value_or(0),
      process.max_descriptors ? fmt::format("{}", *process.max_descriptors) : std::string("any number of"),
      sources_.lost_log_lines());
  if (const auto cluster = cluster_figures()) text += '\n' + status_of(*cluster);
  for (const std::shared_ptr<Room>& room : sources_.lobby.rooms()) {
    text += '\n' + status_of(*room);
    if (room->next_tick().is_too_late(sources_.timekeeper.now())) text += "; TICKS OVERDUE";
  }
  return text;
}

}  // namespace woodlouse::server
