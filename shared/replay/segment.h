// What stands between one keyframe and the next, re-run and judged.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/rerun.h"

namespace woodlouse::replay {

struct Segment {
  std::uint64_t steps = 0;
  std::optional<Difference> difference;
  std::optional<Keyframe> next;  ///< where it ended; empty: at the end of the recording
  bool has_end = false;          ///< the end line was read, and nothing behind it
};

/// Re-runs from `start`, which `reader` has read last, through the next keyframe or the end. Errors: lines
/// that are damaged or do not follow each other.
core::Expected<Segment> run_segment(ReplayReader& reader, const std::shared_ptr<const map::Map>& map,
                                    const match::MatchSettings& settings, Keyframe start);

}  // namespace woodlouse::replay
