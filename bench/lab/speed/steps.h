// One louse through one tick: ours scalar and batched, by every integrator of note, and the document's.
#pragma once

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

core::Expected<void> measure_steps(const Output& output);

}  // namespace woodlouse::lab
