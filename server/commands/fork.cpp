#include "server/commands/fork.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "shared/core/joined.h"
#include "shared/protocol/text_cleaning.h"
#include "shared/replay/archive.h"
#include "shared/replay/recorded_map_file.h"
#include "shared/replay/source_file.h"

namespace woodlouse::server {
namespace {

using core::joined;
using replay::ReplayArchive;

core::Error without_tick(const ReplayArchive& archive, const ForkPoint& point) {
  const std::string last = std::to_string(archive.last_tick());
  return {point.recording.string(),
          joined({"has no tick ", std::to_string(point.tick), ", only ", std::to_string(archive.first_tick()),
                  " to ", last}),
          joined({"try:  woodlouse-server fork ", point.recording.string(), " --tick ", last})};
}

/// By louse. A louse that nobody named can't be asked for.
std::vector<Seat> unclaimed_seats(const ReplayArchive& archive, const match::Match& match) {
  std::vector<Seat> seats;
  for (const match::PlayerSeq& player : match.state().players) {
    if (!match.contains(player.player)) continue;
    const auto& spans = archive.players();
    const auto span =
        std::lower_bound(spans.begin(), spans.end(), player.player,
                         [](const replay::PlayerSpan& p, match::PlayerId id) { return p.player < id; });
    if (span == spans.end() || span->player != player.player) continue;
    std::string name = protocol::clean_text(span->label.name, protocol::kMaxNameBytes);
    if (name.empty()) continue;
    seats.push_back({player.player, std::move(name), span->label.role,
                     player.last_seq ? *player.last_seq + 1 : 0, Nobody{}});
  }
  return seats;
}

core::Error with_advice(const core::Error& error, const ForkPoint& point) {
  if (!error.hint.empty()) return error;
  return {error.where, error.what,
          joined({"is it whole?   try:  woodlouse-server verify ", point.recording.string()})};
}

}  // namespace

core::Expected<Start> open_fork(const ForkPoint& point) {
  const auto archive = ReplayArchive::open(replay::source_of_file(point.recording, point.maps));
  if (!archive) return tl::unexpected(with_advice(archive.error(), point));
  if (point.tick < (*archive)->first_tick() || point.tick > (*archive)->last_tick())
    return tl::unexpected(without_tick(**archive, point));
  const auto playback = (*archive)->play(point.tick);
  if (!playback) return tl::unexpected(with_advice(playback.error(), point));
  if (const auto difference = (*playback)->first_difference())
    return core::fail(
        point.recording.string(),
        joined({"differs at tick ", std::to_string(*difference), ": what follows was never played"}),
        joined({"take a tick before it, or ask:  woodlouse-server verify ", point.recording.string()}));
  const match::MatchState state = (*playback)->match().state();
  if (!state.roster.empty())
    return core::fail(point.recording.string(),
                      joined({"at tick ", std::to_string(point.tick), " somebody is about to join or leave"}),
                      "take the tick after it");
  Start start;
  start.map = (*archive)->map();
  start.match = match::Match::restore(start.map, (*playback)->match().settings(), state);
  start.map_file =
      replay::map_file_of((*archive)->header(), {point.recording.parent_path(), point.maps}).string();
  start.unclaimed = unclaimed_seats(**archive, *start.match);
  start.parent = replay::Parent{point.recording.string(), state.tick, state.hash};
  return start;
}

}  // namespace woodlouse::server
