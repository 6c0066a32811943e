// Integrators under central gravity against Kepler's ellipses, position and time.
#pragma once

#include "bench/lab/report/output.h"
#include "shared/core/error.h"

namespace woodlouse::lab {

/// Writes lab-precision-kepler.
core::Expected<void> measure_kepler(const Output& output);

}  // namespace woodlouse::lab
