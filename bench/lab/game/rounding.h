// What rounding does to the energy in ten million steps.
#pragma once

#include "bench/lab/report/output.h"

namespace woodlouse::lab {

/// Lice in a bowl, gravity and curvature alone, 10^3 to 10^7 steps (quick: 10^5): the energy's error by the
/// server's own steps and by the same formulas written once for double and long double, which says how much
/// of it is the method's. Writes lab-rounding.csv and draws it.
core::Expected<void> measure_rounding(const Output& output);

}  // namespace woodlouse::lab
