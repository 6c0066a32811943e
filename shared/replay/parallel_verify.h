// The segments of a recording checked by several threads: the one place in shared/ that has any.
#pragma once

#include "shared/core/error.h"
#include "shared/replay/source.h"
#include "shared/replay/verify.h"

namespace woodlouse::replay {

/// verify()'s verdict, with the segments between keyframes checked by `jobs` >= 1 threads at once, which have
/// ended when it returns. An index that does not lead from each segment to the next is not trusted: then the
/// recording is read through.
core::Expected<Verification> verify(const ReplaySource& source, unsigned jobs);

}  // namespace woodlouse::replay
