// What stands between one keyframe and the next, re-run and judged.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/replay/index.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/rerun.h"

namespace woodlouse::replay {

struct Segment {
  std::uint64_t steps = 0;
  std::optional<Difference> difference;
  std::optional<Keyframe> next;      ///< where it ended; empty: at the end of the recording
  std::optional<ReplayIndex> index;  ///< as recorded, where it was met
  std::uint64_t index_offset = 0;    ///< bytes that the reader took before it
  std::optional<End> end;            ///< the end line was read, and nothing behind it
};

/// Re-runs from `start`, which `reader` has read last, through the next keyframe or the end; what the steps
/// and chats between tell is added to `lines`. Errors: lines that are damaged or do not follow each other.
core::Expected<Segment> run_segment(ReplayReader& reader, const std::shared_ptr<const map::Map>& map,
                                    const match::MatchSettings& settings, Keyframe start, ReplayIndex& lines);

/// Where the recorded index, or the end's word where it stands, is not what the lines are; nothing: it is, or
/// there is none. `last`: the recording's last segment, whose reader began at that byte.
std::optional<Difference> index_difference(const Segment& last, std::uint64_t begin,
                                           const ReplayIndex& lines);

}  // namespace woodlouse::replay
