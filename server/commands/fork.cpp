#include "server/commands/fork.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "shared/core/joined.h"
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

core::Error with_advice(const core::Error& error, const ForkPoint& point) {
  if (!error.hint.empty()) return error;
  return {error.where, error.what,
          joined({"is it whole?   try:  woodlouse-server verify ", point.recording.string()})};
}

core::Expected<void> check_played(const replay::Playback& playback, const ForkPoint& point) {
  const auto& difference = playback.first_difference();
  if (!difference) return {};
  return core::fail(
      point.recording.string(),
      joined({"differs at tick ", std::to_string(difference->tick), ": ", difference->what,
              ": what follows was never played"}),
      joined({"take a tick before it, or ask:  woodlouse-server verify ", point.recording.string()}));
}

/// The inputs that wait at the fork's tick are those that the recording goes on to apply: it is re-run until
/// all of them were due, two seconds at most. How many the recording does not tell of, because it ends before
/// or their player left: what waits stands in a keyframe, and in no hash.
core::Expected<std::size_t> check_waiting(replay::Playback& playback,
                                          const std::vector<match::AppliedInput>& waiting,
                                          const ForkPoint& point) {
  std::size_t met = 0;
  while (!waiting.empty() && playback.tick() <= waiting.back().tick) {
    const auto step = playback.advance();
    if (!step) return tl::unexpected(with_advice(step.error(), point));
    if (auto played = check_played(playback, point); !played) return tl::unexpected(played.error());
    if (!*step) break;
    const std::vector<match::AppliedInput>& applied = (*step)->recorded.step.inputs;
    met += static_cast<std::size_t>(
        std::count_if(waiting.begin(), waiting.end(), [&](const match::AppliedInput& input) {
          return std::find(applied.begin(), applied.end(), input) != applied.end();
        }));
  }
  return waiting.size() - met;
}

/// "the keyframe of tick 900 and 2 waiting inputs"; empty: nothing.
std::string on_trust(const replay::Playback& playback, std::size_t inputs) {
  const std::uint64_t keyframe = playback.proven_since();
  std::string text =
      keyframe == 0 ? std::string() : joined({"the keyframe of tick ", std::to_string(keyframe)});
  if (inputs == 0) return text;
  return joined({text, text.empty() ? "" : " and ", std::to_string(inputs),
                 inputs == 1 ? " waiting input" : " waiting inputs"});
}

}  // namespace

core::Expected<Start> open_fork(const ForkPoint& point) {
  const auto archive = ReplayArchive::open(replay::source_of_file(point.recording, point.maps));
  if (!archive) return tl::unexpected(with_advice(archive.error(), point));
  if (point.tick < (*archive)->first_tick() || point.tick > (*archive)->last_tick())
    return tl::unexpected(without_tick(**archive, point));
  const auto playback = (*archive)->play(point.tick);
  if (!playback) return tl::unexpected(with_advice(playback.error(), point));
  if (auto played = check_played(**playback, point); !played) return tl::unexpected(played.error());
  const match::MatchState state = (*playback)->match().state();
  if (!state.roster.empty())
    return core::fail(point.recording.string(),
                      joined({"at tick ", std::to_string(point.tick), " somebody is about to join or leave"}),
                      "take the tick after it");
  Start start;
  start.map = (*archive)->map();
  start.match = match::Match::restore(start.map, (*playback)->match().settings(), counted_anew(state));
  start.map_file =
      replay::map_file_of((*archive)->header(), {point.recording.parent_path(), point.maps}).string();
  start.unclaimed = unclaimed_seats(*start.match);
  start.parent = replay::Parent{point.recording.string(), state.tick, state.hash};
  const auto untold = check_waiting(**playback, state.waiting, point);
  if (!untold) return tl::unexpected(untold.error());
  start.on_trust = on_trust(**playback, *untold);
  return start;
}

}  // namespace woodlouse::server
