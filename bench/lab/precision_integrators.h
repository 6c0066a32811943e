// Every integrator at every rate: ns per simulated second against the position's error.
#pragma once

#include "bench/lab/report/output.h"
#include "shared/terrain/function_surface.h"

namespace woodlouse::lab {

core::Expected<void> measure_integrators(terrain::FunctionName function, const Output& output);

}  // namespace woodlouse::lab
