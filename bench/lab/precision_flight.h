// Integrators on a unilateral map against a jump in closed form: take-off, landing and the way on; and what
// flying costs.
#pragma once

#include "bench/lab/report/output.h"
#include "shared/core/error.h"

namespace woodlouse::lab {

/// Writes lab-precision-flight.
core::Expected<void> measure_flight(const Output& output);
/// Writes lab-precision-flight-cost.
core::Expected<void> measure_flight_cost(const Output& output);

}  // namespace woodlouse::lab
