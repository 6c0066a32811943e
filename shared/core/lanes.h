// One template for a double and for several at once. The equations are written over T; with T = double they
// are the scalar step, with T = Lanes4 or Lanes8 (lanes_avx2.h, lanes_avx512.h) the batched one. Each
// operation rounds each lane as the scalar one does, and the order is the template's, so the bits are the
// same.
#pragma once

#include <cmath>

#include "shared/core/exact_arithmetic.h"

namespace woodlouse::core {

inline double square_root(double a) { return std::sqrt(a); }
inline double magnitude(double a) { return std::fabs(a); }
/// chosen ? a : b, lane by lane.
inline double select(bool chosen, double a, double b) { return chosen ? a : b; }
/// Whether any lane is chosen.
inline bool any(bool chosen) { return chosen; }

}  // namespace woodlouse::core
