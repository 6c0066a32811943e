#include "server/logging/events.h"

#include <array>
#include <cassert>

namespace woodlouse::server {
namespace {

namespace level = spdlog::level;

constexpr std::array<LogEventEntry, kLogEventCount> kEvents{{
    {"stopping", level::info, "a signal ends the server; everybody is told"},
    {"stop_incomplete", level::warn, "rooms or ports did not stop in time, it ends without them"},
    {"reloaded", level::warn, "limits, log level and certificate are read again"},
    {"reload_failed", level::err, "something of them can't be used and is as it was: the line says what"},
    {"reopened", level::info, "recordings go on in new files from their next keyframe on"},
    {"certificate_refused", level::err, "a new certificate can't be used, the old one serves on"},
    {"operator", level::info, "what else was asked for at the admin door, or done"},
    {"moderator", level::info, "what a moderator has asked for in a game"},
    {"draining", level::info, "nobody is let in any more, by an operator's word; the server ends then"},
    {"kicked", level::info, "an operator has put somebody out"},
    {"banned", level::info, "an operator has banned an address, a network or a name"},
    {"ban_failed", level::err, "he has not: the file of bans can't be written"},
    {"unbanned", level::info, "an operator has lifted a ban"},
    {"muted", level::info, "an operator has muted an address or a name"},
    {"log_lines_lost", level::warn, "how many lines nobody read in time"},
    {"room_opened", level::info,
     "a room, with its map, rates, seed and what was done to its ground, or the recording it goes on from"},
    {"rotation_opened", level::info, "a room in which games take turns"},
    {"game_began", level::info, "the next game of such a room"},
    {"game_not_written", level::err, "something of it can't be written: it is played without"},
    {"clock_moved", level::warn, "a tick came too late for its time to be made up for"},
    {"room_asleep", level::info, "nobody is in the room any more, it stands still"},
    {"room_awake", level::info, "somebody has come, it goes on"},
    {"room_paused", level::info, "an operator has paused the room, it stands still"},
    {"room_resumed", level::info, "an operator lets it go on"},
    {"room_closed", level::info, "an operator has closed it"},
    {"louse_taken_over", level::info, "somebody joined under a recorded name and has its louse"},
    {"map_unreadable", level::err, "a big map's file can't be read, ground without data stands in for it"},
    {"connected", level::debug, "a connection, with address and port"},
    {"joined", level::info, "a session is in a room"},
    {"came_back", level::info, "a session has its louse again"},
    {"left", level::info, "a session left by its own word"},
    {"connection_ended", level::info, "a session's connection ended without a word"},
    {"session_ended", level::info, "the server ended a session; code and text as it was told"},
    {"tls_refused", level::debug, "somebody spoke TLS where there is no certificate"},
    {"proxy_header_refused", level::warn,
     "what a trusted proxy began with is no header of the PROXY protocol's version 2: closed"},
    {"accept_failed", level::err, "the system gives no connection: no descriptor, no memory; told once"},
    {"socket_options_failed", level::warn, "a connection is served without them"},
    {"close_failed", level::warn, "the system says that closing failed"},
    {"recording_renamed", level::warn, "a file of that name was there, the recording has another one"},
    {"recording_continued", level::info, "a recording goes on in the next file"},
    {"recording_not_followed", level::err,
     "the next file can't be made, the recording goes on in its old one"},
    {"recording_no_file", level::warn, "it is no file that another could follow"},
    {"recording_ended", level::err, "a recording has ended before its time, the game goes on"},
    {"recording_unfinished", level::err, "the server ended before a recording did"},
    {"recordings_removed", level::info, "the oldest recordings went for `--record-keep`"},
    {"chat_left_out", level::warn, "more was said in a tick than a recording holds"},
    {"shadow_differs", level::err, "a tick and its re-run differ; the files that hold both"},
    {"shadow_ended", level::err, "ticks of the room are no longer compared"},
    {"board_torn", level::warn, "the last line of a file of records was cut off"},
    {"board_line_passed_over", level::err, "a line of a file of records is none"},
    {"record_refused", level::err, "a run on file, or one just driven, is not what its re-run says"},
    {"run_no_record", level::info, "a run counts for no board: too long, or begun too early"},
    {"run_left_out", level::warn, "too many runs wait to be re-run"},
    {"records_not_written", level::err, "runs stand on a board and in no file yet"},
    {"records_written_again", level::warn, "they are written now"},
    {"cluster_follows", level::info, "this host follows the log of another one, and stands by"},
    {"cluster_owns", level::warn, "the rooms of the shard are this host's from now on"},
    {"cluster_fenced", level::err, "another host has taken the log over; the rooms end here"},
    {"cluster_hole", level::err, "something is missing in the log: the line says what, and what goes on"},
    {"cluster_differs", level::err,
     "what this host re-runs is not what the log says; it takes nothing of it over"},
    {"cluster_not_durable", level::err, "nothing has been stored for 10 s; the rooms go on"},
    {"cluster_durable", level::warn, "what is played is stored again"},
    {"cluster_fault", level::warn,
     "NATS does not answer as it should, or what it brings is no log; told once in a row"},
}};
static_assert(static_cast<std::size_t>(LogEvent::kClusterFault) + 1 == kLogEventCount);

/// A message carries its event where spdlog's macros leave the name of the function that logs. Line 0: it is
/// no place in the code.
constexpr const char* kMark = "event";

}  // namespace

std::span<const LogEventEntry> log_events() { return kEvents; }

const LogEventEntry& entry_of(LogEvent event) {
  const auto index = static_cast<std::size_t>(event);
  assert(index < kEvents.size());
  return kEvents[index];
}

spdlog::source_loc borne_by(LogEvent event) { return {kMark, 0, entry_of(event).name.data()}; }

void log_event(spdlog::logger& log, LogEvent event, const std::string& text) {
  log.log(borne_by(event), entry_of(event).level, spdlog::string_view_t(text.data(), text.size()));
}

bool is_logged(const spdlog::logger& log, LogEvent event) { return log.should_log(entry_of(event).level); }

std::string_view event_of(const spdlog::details::log_msg& message) {
  return message.source.filename == kMark ? std::string_view(message.source.funcname) : std::string_view();
}

}  // namespace woodlouse::server
