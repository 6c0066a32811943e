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

core::Expected<void> check_end(ReplayReader& reader, const End& end, std::uint64_t tick) {
  if (end.tick != tick) {
    return core::fail(
        joined({reader.place(), ": end"}),
        joined({"tick ", std::to_string(end.tick), " after step lines up to tick ", std::to_string(tick)}),
        "lines are missing");
  }
  const core::Expected<std::optional<Line>> behind = reader.next();
  if (!behind) return tl::unexpected(behind.error());
  if (*behind) return core::fail(reader.place(), "stands after the end");
  return {};
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
    const std::uint64_t tick = (*rerun)->match().tick();
    if (auto* keyframe = std::get_if<Keyframe>(&**line)) {
      if (keyframe->state.tick != tick || segment.steps == 0) {
        return core::fail(reader.place(),
                          joined({"a keyframe of tick ", std::to_string(keyframe->state.tick),
                                  " stands where tick ", std::to_string(tick), " is reached"}));
      }
      compare(**rerun, *keyframe, segment);
      segment.next = std::move(*keyframe);
      return segment;
    }
    if (const auto* end = std::get_if<End>(&**line)) {
      if (auto checked = check_end(reader, *end, tick); !checked) return tl::unexpected(checked.error());
      segment.has_end = true;
      break;
    }
  }
  if (segment.difference) segment.difference->detail = "no keyframe follows that could say which louse";
  return segment;
}

}  // namespace woodlouse::replay
