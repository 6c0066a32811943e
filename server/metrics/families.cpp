#include "server/metrics/families.h"

#include <array>
#include <cassert>

namespace woodlouse::server {
namespace {

using enum MetricKind;

constexpr std::array<FamilyEntry, kFamilyCount> kFamilies{{
    {"woodlouse_build_info", kGauge, "version, behavior, protocol",
     "Constant 1; version and behavior of the build."},
    {"woodlouse_room_ticks_total", kCounter, "room", "Steps performed."},
    {"woodlouse_room_tick_lateness_seconds", kHistogram, "room", "How late a tick began."},
    {"woodlouse_room_tick_work_seconds", kHistogram, "room", "How long a tick took."},
    {"woodlouse_room_tick_overdue_seconds", kGauge, "room",
     "For how long the next tick has been due by now; 0 where none is."},
    {"woodlouse_room_clock_moves_total", kCounter, "room",
     "Times the clock moved because ticks came too late."},
    {"woodlouse_room_asleep", kGauge, "room",
     "Whether the room stands still, as nobody is there or an operator has paused it."},
    {"woodlouse_room_sleeps_total", kCounter, "room", "Times it began to stand still."},
    {"woodlouse_room_members", kGauge, "room, role", "Who is in the room now."},
    {"woodlouse_room_frames_encoded_total", kCounter, "room", "Frames encoded, of every layout."},
    {"woodlouse_room_map_read_failures_total", kCounter, "room",
     "Reads of a big map's file that failed: its recording may not verify."},
    {"woodlouse_shadow_ticks_total", kCounter, "room", "Ticks that --shadow has re-run and compared."},
    {"woodlouse_shadow_differences_total", kCounter, "room", "Ticks whose re-run differed."},
    {"woodlouse_shadow_ended", kGauge, "room",
     "Whether ticks of the room are no longer compared, though --shadow was asked for."},
    {"woodlouse_recording_failed", kGauge, "room",
     "Whether the room's recording has ended before its time, or one of a game before."},
    {"woodlouse_recording_queue_jobs", kGauge, "room",
     "Steps, and what was said, that wait for the disk; the recording ends past 1200."},
    {"woodlouse_recording_written_bytes_total", kCounter, "room", "Bytes written into recordings."},
    {"woodlouse_recording_lost_bytes_total", kCounter, "room",
     "Bytes made for recordings that could not be written."},
    {"woodlouse_recording_lost_ticks_total", kCounter, "room",
     "Steps that are in no recording, as it had ended before its time."},
    {"woodlouse_recordings_not_opened_total", kCounter, "",
     "Games that are not recorded, as no file could be begun."},
    {"woodlouse_recordings_removed_total", kCounter, "", "Old recordings removed for --record-keep."},
    {"woodlouse_sessions", kGauge, "", "Sessions open now, on every door."},
    {"woodlouse_session_ends_total", kCounter, "code",
     "Sessions ended, by the code of their bye; lost: the connection broke without one."},
    {"woodlouse_sent_bytes_total", kCounter, "", "Bytes of lines written to clients."},
    {"woodlouse_sent_frames_total", kCounter, "", "Frames written to clients, once each."},
    {"woodlouse_received_lines_total", kCounter, "", "Lines read from clients."},
    {"woodlouse_refused_lines_total", kCounter, "code",
     "Lines refused, by the code of the error that answered."},
    {"woodlouse_connections_total", kCounter, "", "Connections accepted."},
    {"woodlouse_connections_limit", kGauge, "", "Connections that there may be at once."},
    {"woodlouse_connections_refused_total", kCounter, "reason",
     "Connections that nobody was let in by, and failed attempts to accept one."},
    {"woodlouse_web_requests_total", kCounter, "",
     "HTTP requests answered, upgrades to WebSockets among them."},
    {"woodlouse_web_refused_total", kCounter, "status", "HTTP requests refused, by status."},
    {"woodlouse_web_sessions", kGauge, "", "Sessions open now that are WebSockets."},
    {"woodlouse_log_lines_lost_total", kCounter, "",
     "Lines of the log that nobody read in time or that could not be written."},
    {"woodlouse_cluster_owns", kGauge, "", "Whether the shard's rooms are this host's."},
    {"woodlouse_cluster_ready", kGauge, "", "Whether this host stands by and could go on with them."},
    {"woodlouse_cluster_differs", kGauge, "",
     "Whether what this host re-runs is not what the log says: it takes nothing over."},
    {"woodlouse_cluster_connected", kGauge, "", "Whether this host is connected to NATS."},
    {"woodlouse_cluster_hosts", kGauge, "role",
     "Other hosts of the shard that this one hears, by what they do."},
    {"woodlouse_cluster_batch", kGauge, "",
     "Sequence number of the log's last batch that this host knows to be stored, or has read."},
    {"woodlouse_cluster_batches_waiting", kGauge, "",
     "Batches of this host, or parts of one, that are not acknowledged; what comes meanwhile goes into the "
     "next."},
    {"woodlouse_cluster_unacknowledged_seconds", kGauge, "",
     "For how long none of those that wait was acknowledged; 0 where none waits."},
    {"woodlouse_cluster_batches_stored_total", kCounter, "", "Batches of this host that were acknowledged."},
    {"woodlouse_cluster_takeovers_total", kCounter, "", "Times this host has taken the shard's log over."},
    {"woodlouse_cluster_fenced_total", kCounter, "",
     "Times another host has taken the log over from this one, which did not leave it."},
    {"woodlouse_cluster_holes_total", kCounter, "",
     "Times something was missing in the log, and rooms were told anew or lost."},
    {"process_start_time_seconds", kGauge, "", "When the server started, in seconds since 1970."},
    {"process_cpu_seconds_total", kCounter, "", "Processor time of the server, user and system."},
    {"process_resident_memory_bytes", kGauge, "", "Memory of the server that is in RAM."},
    {"process_open_fds", kGauge, "", "Descriptors that are open."},
    {"process_max_fds", kGauge, "", "Descriptors that may be open."},
}};
static_assert(static_cast<std::size_t>(Family::kProcessDescriptorsLimit) + 1 == kFamilyCount);

}  // namespace

std::span<const FamilyEntry> families() { return kFamilies; }

const FamilyEntry& entry_of(Family family) {
  const auto index = static_cast<std::size_t>(family);
  assert(index < kFamilies.size());
  return kFamilies[index];
}

std::string_view to_text(MetricKind kind) {
  switch (kind) {
    case kCounter:
      return "counter";
    case kGauge:
      return "gauge";
    case kHistogram:
      break;
  }
  assert(kind == kHistogram);
  return "histogram";
}

}  // namespace woodlouse::server
