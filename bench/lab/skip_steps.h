// What steps and frames leave out: forces, resting lice, Hessians, columns, attitude.
#pragma once

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// Adds rows of (what, unit, computed, skipped).
core::Expected<void> measure_skipped_steps(Table& table, Effort effort);

}  // namespace woodlouse::lab
