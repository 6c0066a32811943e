// The line that a recording has most of, read without a document: a step, as the writer writes it.
#pragma once

#include <optional>
#include <string_view>

#include "shared/replay/format.h"

namespace woodlouse::replay {

/// What ReplayReader gives for a line {"step":...,"inputs":[...],"hash":"..."}, with inputs or without, that
/// has nothing unusual: no roster, thrusts in whole quanta, everything in range. Nothing: it is another line,
/// or one that only the document's parser can judge.
std::optional<StepLine> scan_step(std::string_view line);

}  // namespace woodlouse::replay
