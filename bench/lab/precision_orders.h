// The order of the rooms' methods, event by event: walls, seams, take-offs, landings, stops, thrusts.
#pragma once

#include "bench/lab/report/output.h"
#include "shared/core/error.h"

namespace woodlouse::lab {

/// Prints the table; writes no file.
core::Expected<void> measure_orders(const Output& output);

}  // namespace woodlouse::lab
