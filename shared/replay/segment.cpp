#include "shared/replay/segment.h"

#include <string>
#include <utility>

#include "shared/core/joined.h"
#include "shared/replay/writer.h"

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
                                    const match::MatchSettings& settings, Keyframe start,
                                    ReplayIndex& lines) {
  auto rerun = Rerun::from_recorded(map, settings, std::move(start), reader.place());
  if (!rerun) return tl::unexpected(rerun.error());
  Segment segment;
  for (;;) {
    core::Expected<std::optional<Line>> line = reader.next();
    if (!line) return tl::unexpected(line.error());
    if (!*line) {
      if (reader.is_cut_off()) segment.end.reset();
      break;
    }
    if (const auto* step = std::get_if<StepLine>(&**line)) {
      auto difference = (*rerun)->step(*step, reader.place());
      if (!difference) return tl::unexpected(difference.error());
      ++segment.steps;
      lines.add(*step);
      const bool is_first = !segment.difference && difference->has_value();
      if (!segment.difference) segment.difference = std::move(*difference);
      // What is known to be wrong is worth as many steps as lie before a keyframe, which may say of whom.
      const std::uint64_t quiet_ones = reader.quiet_steps();
      if (segment.difference && quiet_ones > 0 &&
          (is_first || quiet_ones > keyframe_ticks(settings.tick_hz))) {
        segment.difference->detail =
            is_first ? "the recording says that nothing moved then, nor in the steps behind it"
                     : "no keyframe follows soon that could say which louse";
        return segment;
      }
      const std::uint64_t quiet = (*rerun)->stand_still(reader.quiet_steps());
      if (quiet > 0) {
        reader.skip_quiet(quiet);
        segment.steps += quiet;
        lines.last_tick += quiet;
      }
    }
    if (auto* keyframe = std::get_if<Keyframe>(&**line)) {
      compare(**rerun, *keyframe, segment);
      segment.next = std::move(*keyframe);
      return segment;
    }
    if (const auto* chat = std::get_if<ChatLine>(&**line)) lines.add(*chat);
    if (std::holds_alternative<IndexLine>(**line)) {
      auto index = parse_index(reader.line(), reader.source(), reader.line_number());
      if (!index) return tl::unexpected(index.error());
      segment.index = std::move(*index);
      segment.index_offset = reader.line_offset();
    }
    if (auto* end = std::get_if<End>(&**line)) segment.end = std::move(*end);
  }
  if (segment.difference) segment.difference->detail = "no keyframe follows that could say which louse";
  return segment;
}

std::optional<Difference> index_difference(const Segment& last, std::uint64_t begin,
                                           const ReplayIndex& lines) {
  if (!last.index) return std::nullopt;
  const std::uint64_t offset = begin + last.index_offset;
  std::string unlike = unlike_index(*last.index, lines);
  if (unlike.empty() && last.end && last.end->index_offset != offset) {
    unlike = joined({"where it stands, ", std::to_string(last.end->index_offset), " bytes: it is ",
                     std::to_string(offset)});
  }
  if (unlike.empty()) return std::nullopt;
  return Difference{lines.last_tick, joined({"the index is not that of the lines before it: ", unlike}),
                    "every tick up to it is the same"};
}

}  // namespace woodlouse::replay
