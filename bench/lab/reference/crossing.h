// The moment at which a value falls below 0, to the last digits of a long double.
#pragma once

#include <cassert>
#include <cmath>

#include "bench/lab/reference/dop853.h"

namespace woodlouse::lab::reference {

/// The end of the first stretch found on which value(t) is not negative, t in [0, h]; the last call of
/// `value` was with what is returned. REQUIRES value(h) < 0. Where the value begins at 0 or below, what rises
/// from there is looked for in ever shorter times; 0 if nothing does. Regula falsi (Illinois) inside a
/// bracket.
template <typename Value>
Real crossing(Real h, const Value& value) {
  assert(h >= 0);
  Real low = 0, high = h;
  Real at_low = value(low), at_high = value(high);
  for (int i = 0; !(at_low > 0) && i < 60; ++i) {
    low = i == 0 ? 0.5L * h : 0.5L * low;
    at_low = value(low);
    if (!(at_low > 0)) {
      high = low;
      at_high = at_low;
    }
  }
  if (!(at_low > 0)) {
    value(0);
    return 0;
  }
  int side = 0;
  Real weight_low = at_low, weight_high = at_high;
  for (int i = 0; i < 200 && at_high < 0; ++i) {
    Real t = i % 8 == 7 ? 0.5L * (low + high)
                        : (low * weight_high - high * weight_low) / (weight_high - weight_low);
    if (!(t > low && t < high)) t = 0.5L * (low + high);
    if (!(t > low && t < high)) break;
    const Real there = value(t);
    if (there > 0) {
      low = t;
      at_low = weight_low = there;
      if (side == 1) weight_high *= 0.5L;
      side = 1;
    } else {
      high = t;
      at_high = weight_high = there;
      if (side == -1) weight_low *= 0.5L;
      side = -1;
    }
  }
  value(high);
  return high;
}

}  // namespace woodlouse::lab::reference
