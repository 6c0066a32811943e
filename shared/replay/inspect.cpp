#include "shared/replay/inspect.h"

#include "shared/replay/line_writer.h"

namespace woodlouse::replay {
core::Expected<InspectedState> inspect_state(const ReplayArchive& archive, std::uint64_t tick) {
  const auto playback = archive.play(tick);
  if (!playback) return tl::unexpected(playback.error());
  InspectedState state;
  append_keyframe(state.json, (*playback)->match().state());
  state.difference = (*playback)->first_difference();
  return state;
}

}  // namespace woodlouse::replay
