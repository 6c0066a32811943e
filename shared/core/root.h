// The root of a function between two times. + - * / only, in the order written: these are the simulation's
// bits.
#pragma once

#include <cassert>

namespace woodlouse::core {

/// A time by which f, above 0 at `low`, is so no more: a root, or within 2^-48 of the interval behind one.
/// at_low, at_high: f there; REQUIRES low < high, at_low > 0, and f not above 0 at `high`. The Illinois form
/// of the false position: about eight calls of f where f is smooth, a bisection where it makes no headway.
/// Source: M. Dowell, P. Jarratt, A modified regula falsi method, BIT 11, 1971.
template <typename Function>
[[nodiscard]] double end_of_positive(double low, double at_low, double high, double at_high,
                                     const Function& f) {
  assert(low < high && at_low > 0.0 && !(at_high > 0.0));
  constexpr int kMostCalls = 60;
  const double enough = 0x1p-48 * (high - low);
  int side = 0;
  int stuck = 0;
  for (int call = 0; call < kMostCalls && high - low > enough && at_high < 0.0; ++call) {
    const double width = high - low;
    const double guess = low + at_low / (at_low - at_high) * width;
    const bool trusted = stuck < 3 && guess > low && guess < high;
    const double middle = trusted ? guess : low + 0.5 * width;
    const double value = f(middle);
    const int moved = value > 0.0 ? -1 : 1;
    if (moved < 0) {
      low = middle;
      at_low = value;
      if (side < 0) at_high *= 0.5;
    } else {
      high = middle;
      at_high = value;
      if (side > 0) at_low *= 0.5;
    }
    stuck = trusted && high - low > 0.5 * width ? stuck + 1 : 0;
    side = moved;
  }
  assert(low < high);
  return high;
}

}  // namespace woodlouse::core
