#include "shared/replay/inspect.h"

#include "shared/replay/line_writer.h"

namespace woodlouse::replay {
namespace {

/// Who was there at that tick.
PlayerLabels labels_at(const ReplayArchive& archive, std::uint64_t tick) {
  PlayerLabels labels;
  for (const PlayerSpan& player : archive.players()) {
    const bool is_there = player.joined <= tick && (!player.left || tick < *player.left);
    if (is_there && !player.label.name.empty()) labels[player.player] = player.label;
  }
  return labels;
}

}  // namespace

core::Expected<InspectedState> inspect_state(const ReplayArchive& archive, std::uint64_t tick) {
  const auto playback = archive.play(tick);
  if (!playback) return tl::unexpected(playback.error());
  InspectedState state;
  append_keyframe(state.json, (*playback)->match().state(), labels_at(archive, tick));
  state.difference = (*playback)->first_difference();
  return state;
}

}  // namespace woodlouse::replay
