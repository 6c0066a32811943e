#include "shared/replay/segment.h"

#include <string>
#include <utility>

#include "shared/core/joined.h"

namespace woodlouse::replay {
namespace {

using core::joined;

void compare(const Rerun& rerun, const Keyframe& keyframe, Segment& segment) {
  const std::uint64_t tick = keyframe.state.tick;
  const std::string found = rerun.difference_to(keyframe);
  if (!found.empty() && !segment.difference) {
    segment.difference =
        Difference{tick, "the keyframe is another, though every hash up to it is the same", {}};
  }
  if (!segment.difference) return;
  const bool is_same = found.empty();
  segment.difference->detail =
      joined({"keyframe ", std::to_string(tick), ": ",
              is_same ? "the same lice, so what was altered moved none: a hash, or an input without effect"
                      : found});
}

}  // namespace

core::Expected<Segment> run_segment(ReplayReader& reader, const std::shared_ptr<const map::Map>& map,
                                    const match::MatchSettings& settings, Keyframe start) {
  auto rerun = Rerun::from(map, settings, std::move(start), reader.place());
  if (!rerun) return tl::unexpected(rerun.error());
  Segment segment;
  for (;;) {
    core::Expected<std::optional<Line>> line = reader.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line) break;
    if (const auto* step = std::get_if<StepLine>(&**line)) {
      auto difference = (*rerun)->step(*step, reader.place());
      if (!difference) return tl::unexpected(difference.error());
      ++segment.steps;
      if (!segment.difference) segment.difference = std::move(*difference);
    }
    if (auto* keyframe = std::get_if<Keyframe>(&**line)) {
      compare(**rerun, *keyframe, segment);
      segment.next = std::move(*keyframe);
      return segment;
    }
    segment.has_end |= std::holds_alternative<End>(**line);
  }
  if (segment.difference) segment.difference->detail = "no keyframe follows that could say which louse";
  return segment;
}

}  // namespace woodlouse::replay
