#include "shared/replay/verify.h"

#include <utility>

#include "shared/core/joined.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/segment.h"

namespace woodlouse::replay {

using core::joined;

core::Expected<Verification> verify(const ReplaySource& source) {
  const auto stream = source.open();
  if (!stream) return tl::unexpected(stream.error());
  ReplayReader reader(**stream, source.name);
  const core::Expected<Header> header = reader.read_header();
  if (!header) return tl::unexpected(header.error());
  const auto map = recorded_map(*header, source);
  if (!map) return tl::unexpected(map.error());
  core::Expected<std::optional<Line>> first = reader.next();
  if (!first) return tl::unexpected(first.error());
  if (!*first) return core::fail(source.name, "was cut off before its first keyframe");
  std::optional<Keyframe> start = std::get<Keyframe>(std::move(**first));
  Verification verification;
  verification.first_tick = start->state.tick;
  ReplayIndex lines;
  const auto add = [&](const Keyframe& keyframe) {
    lines.add({keyframe.state.tick, reader.line_offset(), reader.line_number()}, keyframe);
  };
  add(*start);
  bool has_end = false;
  while (start && !verification.difference) {
    core::Expected<Segment> segment =
        run_segment(reader, *map, settings_of(*header), *std::exchange(start, std::nullopt), lines);
    if (!segment) return tl::unexpected(segment.error());
    verification.ticks += segment->steps;
    verification.difference = std::move(segment->difference);
    if (segment->next) add(*segment->next);
    if (!verification.difference) verification.difference = index_difference(*segment, 0, lines);
    start = std::move(segment->next);
    has_end = segment->end.has_value();
  }
  verification.cut_off = !has_end && !verification.difference;
  return verification;
}

std::string to_text(const Verification& verification) {
  if (verification.ok()) {
    return joined({"ok ticks ", std::to_string(verification.first_tick), " to ",
                   std::to_string(verification.first_tick + verification.ticks),
                   verification.from_start() ? "" : ", the start is taken on trust",
                   verification.cut_off ? ", then the recording is cut off: it has no end line" : "", "\n"});
  }
  const Difference& difference = *verification.difference;
  return joined({"differs at tick ", std::to_string(difference.tick), ": ", difference.what, "\n",
                 difference.detail, "\n"});
}

}  // namespace woodlouse::replay
