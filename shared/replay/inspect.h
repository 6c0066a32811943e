// The exact state at a tick of a recording, or what it holds.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "shared/core/error.h"
#include "shared/replay/archive.h"

namespace woodlouse::replay {

/// The state at a tick as one line of JSON, a keyframe's; what of the re-run so far was not as recorded is
/// told by `difference`.
struct InspectedState {
  std::string json;
  std::optional<Difference> difference;  ///< the first since the keyframe before
};
core::Expected<InspectedState> inspect_state(const ReplayArchive& archive, std::uint64_t tick);

/// What the rules of play said, re-run from the beginning: a line each (rules/event.h), to `out`. Errors: the
/// recording is damaged, or was not played so (the lines before that are out by then).
core::Expected<void> inspect_rulings(const ReplayArchive& archive,
                                     const std::function<void(const std::string&)>& out);

/// Header, players, events, and for each player how many inputs, how many of them late, and their margins: as
/// the lines say, all of which are read, and where the index says otherwise. A table for people.
core::Expected<std::string> inspect_summary(const ReplayArchive& archive);

}  // namespace woodlouse::replay
