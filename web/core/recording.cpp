// Recordings (shared/replay): opened, looked at anywhere, proven.
#include <cassert>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "shared/json/object_text.h"
#include "shared/match/found_lice.h"
#include "shared/match/live_error.h"
#include "shared/protocol/messages.h"
#include "shared/replay/archive.h"
#include "shared/replay/playback.h"
#include "shared/replay/verify.h"
#include "web/core/answer.h"
#include "web/core/bytes.h"
#include "web/core/ground.h"
#include "web/core/live_error_text.h"
#include "web/core/shown_match.h"

namespace woodlouse::web {
namespace {

struct OpenRecording {
  std::shared_ptr<const replay::ReplayArchive> archive;
  std::unique_ptr<replay::Playback> playback;
  state::LouseId measured = 0;  ///< 0: nobody
  std::unique_ptr<match::LiveError> error{};
  std::unique_ptr<match::FoundLice> found{};
};

Handles<OpenRecording> recordings;
Handles<replay::Verifier> verifications;

replay::Playback& playback(Handle handle) { return *recordings.at(handle).playback; }

/// How far the steps of who is measured err, from here on.
void begin_error(OpenRecording& recording) {
  recording.error.reset();
  recording.found.reset();
  if (recording.measured == 0) return;
  const replay::Header& header = recording.archive->header();
  const map::Map& map = *recording.archive->map();
  recording.error = std::make_unique<match::LiveError>(map, 1.0 / header.tick_hz, header.mode);
  recording.found = std::make_unique<match::FoundLice>(map, 1.0 / header.tick_hz, header.mode);
}

/// A step forth, of which who is measured is counted.
auto stepped(OpenRecording& recording) {
  const state::Louse* const own =
      recording.error ? recording.playback->match().world().find(recording.measured) : nullptr;
  const state::Louse before = own != nullptr ? *own : state::Louse{};
  auto step = recording.playback->advance();
  if (own == nullptr || !step || !*step) return step;
  const match::StepRecord& record = (*step)->recorded.step;
  for (const state::Louse& louse : recording.found->find({&before, 1}, record))
    recording.error->find(louse, record.tick);
  recording.error->count(1);
  return step;
}

replay::ReplaySource source_of(const char* bytes, std::size_t size) {
  return replay::ReplaySource::of_bytes(std::string(bytes_at(bytes, size)), "the recording");
}

void append_player(std::string& out, const replay::PlayerSpan& player) {
  json::ObjectText text(out);
  text.integer("id", player.player)
      .text("name", player.label.name)
      .text("role", protocol::to_text(player.label.role));
  text.integer("joined", player.joined);
  if (player.left) text.integer("left", *player.left);
  text.end();
}

void append_mark(std::string& out, const replay::Mark& mark) {
  json::ObjectText text(out);
  text.integer("tick", mark.tick).text("kind", to_text(mark.kind)).integer("id", mark.player).end();
}

}  // namespace

/// A file's bytes, plain or zstd, which are copied; it stands at its first tick. 0: it is no recording, or of
/// another behavior, as the answer says.
WOODLOUSE_EXPORT(recording_open) int recording_open(const char* bytes, std::size_t size) {
  auto archive = replay::ReplayArchive::open(source_of(bytes, size));
  if (!archive) return refuse(archive.error());
  auto play = (*archive)->play((*archive)->first_tick());
  if (!play) return refuse(play.error());
  return static_cast<int>(recordings.add(std::make_unique<OpenRecording>(
      OpenRecording{.archive = std::move(*archive), .playback = std::move(*play)})));
}
WOODLOUSE_EXPORT(recording_close) void recording_close(Handle handle) { recordings.close(handle); }

/// Answers with {"first", "last" (ticks), "hz", "mode", "name" (the map's), "build", "behavior", "inputs",
/// "is_cut_off", "end_reason", "players": [{"id", "name", "role", "joined", "left"?}], "marks": [{"tick",
/// "kind": "join", "leave", "respawn" or "chat", "id"}]}
WOODLOUSE_EXPORT(recording_facts) void recording_facts(Handle handle) {
  const replay::ReplayArchive& archive = *recordings.at(handle).archive;
  const replay::Header& header = archive.header();
  json::ObjectText text(answer());
  text.integer("first", archive.first_tick())
      .integer("last", archive.last_tick())
      .integer("hz", header.tick_hz);
  text.text("mode", to_text(header.mode)).text("name", header.map_name).text("build", header.build);
  text.integer("behavior", header.behavior).integer("inputs", archive.index().inputs);
  text.boolean("is_cut_off", archive.is_cut_off()).text("end_reason", archive.end_reason());
  text.array("players", archive.players(), append_player).array("marks", archive.marks(), append_mark).end();
}

WOODLOUSE_EXPORT(recording_ground) Handle recording_ground(Handle handle) {
  return open_ground(recordings.at(handle).archive->map());
}

/// Stands at a tick from first to last; at most five seconds are re-run. False: the file is damaged there, as
/// the answer says; it stands somewhere else then.
WOODLOUSE_EXPORT(recording_seek) bool recording_seek(Handle handle, double tick) {
  const replay::ReplayArchive& archive = *recordings.at(handle).archive;
  assert(tick >= static_cast<double>(archive.first_tick()) &&
         tick <= static_cast<double>(archive.last_tick()));
  const auto done = playback(handle).seek(static_cast<std::uint64_t>(tick));
  begin_error(recordings.at(handle));
  return done ? true : refuse(done.error());
}

/// So many steps forth, fewer at the end. Answers with {"steps" (done), "chats": [{"tick", "id", "name",
/// "text"}]}; false: the file is damaged there, as the answer says.
WOODLOUSE_EXPORT(recording_advance) bool recording_advance(Handle handle, std::uint32_t steps) {
  std::uint32_t done = 0;
  std::vector<replay::ChatLine> chats;
  for (; done < steps; ++done) {
    auto step = stepped(recordings.at(handle));
    if (!step) return refuse(step.error());
    if (!*step) break;
    for (replay::ChatLine& chat : (*step)->chats) chats.push_back(std::move(chat));
  }
  json::ObjectText text(answer());
  text.integer("steps", done);
  text.objects("chats", chats, [](json::ObjectText& object, const replay::ChatLine& chat) {
    object.integer("tick", chat.tick)
        .integer("id", chat.player)
        .text("name", chat.name)
        .text("text", chat.text);
  });
  text.end();
  return true;
}

/// From now on, over the steps forth, how far those of this louse err; 0: nobody's. Another one than before
/// and recording_seek() begin anew.
WOODLOUSE_EXPORT(recording_measure) void recording_measure(Handle handle, std::uint32_t id) {
  OpenRecording& recording = recordings.at(handle);
  if (recording.measured == id) return;
  recording.measured = id;
  begin_error(recording);
}
/// Answers as error_count() does.
WOODLOUSE_EXPORT(recording_error) void recording_error(Handle handle) {
  const OpenRecording& recording = recordings.at(handle);
  if (recording.error)
    answer_error(*recording.error);
  else
    answer() = "null";
}

WOODLOUSE_EXPORT(recording_tick) double recording_tick(Handle handle) {
  return static_cast<double>(playback(handle).tick());
}

/// Until it goes to another tick.
WOODLOUSE_EXPORT(recording_lice) const state::Louse* recording_lice(Handle handle) {
  return playback(handle).match().world().lice().data();
}
WOODLOUSE_EXPORT(recording_count) std::size_t recording_count(Handle handle) {
  return playback(handle).match().world().lice().size();
}

/// Answers with what is proven: {"hash", "since": the tick of the keyframe from which on every tick was
/// re-run, "difference": null, or where it first parted since there: {"tick", "what", "detail"}}
WOODLOUSE_EXPORT(recording_proof) void recording_proof(Handle handle) {
  const replay::Playback& play = playback(handle);
  json::ObjectText text(answer());
  text.hash("hash", play.match().hash()).integer("since", play.proven_since());
  add_difference(text, play.first_difference());
  text.end();
}

/// As those of follower_...
WOODLOUSE_EXPORT(recording_game) void recording_game(Handle handle) {
  answer_game(&playback(handle).match());
}
WOODLOUSE_EXPORT(recording_players) void recording_players(Handle handle) {
  answer_players(&playback(handle).match());
}

WOODLOUSE_EXPORT(recording_standings) void recording_standings(Handle handle) {
  answer_standings(&playback(handle).match());
}

/// A file's bytes, which are copied, to be re-run from its first line by verification_advance().
WOODLOUSE_EXPORT(verification_open) Handle verification_open(const char* bytes, std::size_t size) {
  return verifications.add(std::make_unique<replay::Verifier>(source_of(bytes, size)));
}
WOODLOUSE_EXPORT(verification_close) void verification_close(Handle handle) { verifications.close(handle); }

/// On to the next keyframe. 2: there is more; else the end, of which nothing comes after, and it answers with
/// what `woodlouse-server verify` says, newline included; 1: the same bits throughout, 0: it differs, -1: it
/// is no recording, or damaged.
WOODLOUSE_EXPORT(verification_advance) int verification_advance(Handle handle) {
  replay::Verifier& verifier = verifications.at(handle);
  const auto goes_on = verifier.advance();
  if (!goes_on) {
    answer() = goes_on.error().text() + "\n";
    return -1;
  }
  if (*goes_on) return 2;
  answer() = replay::to_text(verifier.verification());
  return verifier.verification().ok() ? 1 : 0;
}

/// Steps that were re-run so far.
WOODLOUSE_EXPORT(verification_ticks) double verification_ticks(Handle handle) {
  return static_cast<double>(verifications.at(handle).verification().ticks);
}

}  // namespace woodlouse::web
