// What a louse, moving or at rest, and a room in which nobody is take of memory: from the allocator, which is
// asked before and after.
#pragma once

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// Adds rows of (what, unit, computed, skipped). Of a sanitizer's allocator, which tells nothing, they are 0.
/// Errors: the map is not found.
core::Expected<void> measure_memory(Table& table, Effort effort);

}  // namespace woodlouse::lab
