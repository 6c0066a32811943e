// Every surface on finer and finer grids: ns per evaluation against the errors of value and gradient, with
// the orders of convergence between one grid and the next.
#pragma once

#include "bench/lab/report/output.h"
#include "shared/terrain/function_surface.h"

namespace woodlouse::lab {

core::Expected<void> measure_surfaces(terrain::FunctionName function, const Output& output);

}  // namespace woodlouse::lab
