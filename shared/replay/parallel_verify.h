// The segments of a recording checked by several threads: the one place in shared/ that has any.
#pragma once

#include "shared/core/error.h"
#include "shared/replay/source.h"
#include "shared/replay/verify.h"

namespace woodlouse::replay {

/// verify()'s verdict, with the segments between keyframes checked by `jobs` >= 1 threads at once, which have
/// ended when it returns. An index that does not tell each segment and what is in it is not trusted: then,
/// and where a line is longer than a job's share of memory, the recording is read through after all.
core::Expected<Verification> verify(const ReplaySource& source, unsigned jobs);

}  // namespace woodlouse::replay
