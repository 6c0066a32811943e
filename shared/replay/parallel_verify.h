// The stretches of a recording checked by several threads: the one place in shared/ that has any.
#pragma once

#include <optional>

#include "shared/core/error.h"
#include "shared/replay/source.h"
#include "shared/replay/verify.h"

namespace woodlouse::replay {

/// The verdict, the same as of reading it through; nothing when the recording has no index that leads from
/// each stretch to the next, or can't be opened at all: then it must be read through. The threads have ended
/// when it returns.
std::optional<core::Expected<Verification>> verify_in_parallel(const ReplaySource& source, unsigned jobs);

}  // namespace woodlouse::replay
