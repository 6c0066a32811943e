#include "shared/replay/inspect.h"

#include <string>

#include "shared/core/joined.h"
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

core::Expected<void> inspect_rulings(const ReplayArchive& archive,
                                     const std::function<void(const std::string&)>& out) {
  const auto playback = archive.play(archive.index().keyframes.front().tick);
  if (!playback) return tl::unexpected(playback.error());
  const rules::Rules* rules = (*playback)->match().rules();
  for (;;) {
    const auto step = (*playback)->advance();
    if (!step) return tl::unexpected(step.error());
    if (!*step) return {};
    if (!(*step)->is_proven())
      return core::fail(archive.source().name,
                        core::joined({"differs at tick ", std::to_string((*playback)->tick())}),
                        "ask verify");
    if (rules == nullptr) continue;
    for (const rules::Event& event : rules->events()) out(to_text(event));
  }
}

}  // namespace woodlouse::replay
