// Watching by inputs: the room's recording as it comes over the wire, re-run and proven (shared/follow).
#include "shared/follow/follower.h"

#include <cassert>
#include <cstdint>
#include <memory>

#include "shared/json/object_text.h"
#include "web/core/answer.h"
#include "web/core/bytes.h"
#include "web/core/ground.h"
#include "web/core/shown_match.h"

namespace woodlouse::web {
namespace {

Handles<follow::Follower> followers;

}  // namespace

WOODLOUSE_EXPORT(follower_open) Handle follower_open() {
  return followers.add(std::make_unique<follow::Follower>("the server's stream"));
}
WOODLOUSE_EXPORT(follower_close) void follower_close(Handle handle) { followers.close(handle); }

/// The next line, without its newline. False: it differs (follower_facts), and every further one is passed
/// over.
WOODLOUSE_EXPORT(follower_take) bool follower_take(Handle handle, const char* line, std::size_t size) {
  const std::string_view text = bytes_at(line, size);
  return followers.at(handle).take(text.substr(0, text.find('\n')));
}

/// Another session begins; what was proven stays counted.
WOODLOUSE_EXPORT(follower_begin_anew) void follower_begin_anew(Handle handle) {
  followers.at(handle).begin_anew();
}

/// The tick of what is shown; -1: nothing is yet, or it differs.
WOODLOUSE_EXPORT(follower_tick) double follower_tick(Handle handle) {
  const match::Match* match = followers.at(handle).match();
  return match == nullptr ? -1.0 : static_cast<double>(match->tick());
}
/// Ticks that were re-run here with the hash that the server said.
WOODLOUSE_EXPORT(follower_proven) double follower_proven(Handle handle) {
  return static_cast<double>(followers.at(handle).proven());
}

/// Until the next line is taken; none where there is no tick.
WOODLOUSE_EXPORT(follower_lice) const state::Louse* follower_lice(Handle handle) {
  const match::Match* match = followers.at(handle).match();
  return match == nullptr ? nullptr : match->world().lice().data();
}
WOODLOUSE_EXPORT(follower_count) std::size_t follower_count(Handle handle) {
  const match::Match* match = followers.at(handle).match();
  return match == nullptr ? 0 : match->world().lice().size();
}

/// A handle on its map; 0: it has none yet.
WOODLOUSE_EXPORT(follower_ground) Handle follower_ground(Handle handle) {
  const match::Match* match = followers.at(handle).match();
  return match == nullptr ? 0 : open_ground(match->shared_map());
}

/// Answers with {"hash", "hz", "mode", "gaps", "proven", "difference": null or {"tick", "what"}}; hash, hz
/// and mode where there is a tick.
WOODLOUSE_EXPORT(follower_facts) void follower_facts(Handle handle) {
  const follow::Follower& follower = followers.at(handle);
  json::ObjectText text(answer());
  if (const match::Match* match = follower.match()) {
    text.hash("hash", match->hash()).integer("hz", match->settings().tick_hz);
    text.text("mode", to_text(match->settings().mode));
  }
  text.integer("gaps", follower.gaps()).integer("proven", follower.proven());
  add_difference(text, follower.difference());
  text.end();
}

/// Answers with the rules' state as a frame's `game` (docs/protocol.md), whole, or null.
WOODLOUSE_EXPORT(follower_game) void follower_game(Handle handle) {
  answer_game(followers.at(handle).match());
}

/// Answers with who plays: [{"id", "name", "role"}, ...]
WOODLOUSE_EXPORT(follower_players) void follower_players(Handle handle) {
  answer_players(followers.at(handle).match());
}

/// Answers with how each stands who plays by rules (shown_match.h).
WOODLOUSE_EXPORT(follower_standings) void follower_standings(Handle handle) {
  answer_standings(followers.at(handle).match());
}

}  // namespace woodlouse::web
