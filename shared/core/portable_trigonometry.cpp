#include "shared/core/portable_trigonometry.h"

#include <cassert>

namespace woodlouse::core {
namespace {

constexpr double kTwoOverPi = 6.36619772367581382433e-01;
constexpr double kHalfPiHigh = 1.57079632673412561417e+00;    // 33 bits, so that n * part is exact
constexpr double kHalfPiMiddle = 6.07710050630396597660e-11;  // the next 33 bits
constexpr double kHalfPiLow = 2.02226624879595063154e-21;     // the rest

// Minimax coefficients on [-pi/4, pi/4]; tail is the part of the argument below its last bit.
double sin_kernel(double r, double tail) {
  const double r2 = r * r;
  const double r3 = r2 * r;
  const double p = 8.33333333332248946124e-03 +
                   r2 * (-1.98412698298579493134e-04 +
                         r2 * (2.75573137070700676789e-06 +
                               r2 * (-2.50507602534068634195e-08 + r2 * 1.58969099521155010221e-10)));
  return r - ((r2 * (0.5 * tail - r3 * p) - tail) - r3 * -1.66666666666666324348e-01);
}

double cos_kernel(double r, double tail) {
  const double r2 = r * r;
  const double p =
      r2 * (4.16666666666666019037e-02 +
            r2 * (-1.38888888888741095749e-03 +
                  r2 * (2.48015872894767294178e-05 +
                        r2 * (-2.75573143513906633035e-07 +
                              r2 * (2.08757232129817482790e-09 + r2 * -1.13596475577881948265e-11)))));
  const double half = 0.5 * r2;
  const double head = 1.0 - half;
  return head + (((1.0 - head) - half) + (r2 * p - r * tail));
}

}  // namespace

SinCos portable_sincos(double radians) {
  assert(radians >= -1e5 && radians <= 1e5);
  const double turns = radians * kTwoOverPi;
  const long long quadrant = static_cast<long long>(turns + (turns >= 0.0 ? 0.5 : -0.5));
  const double n = static_cast<double>(quadrant);
  const double high = radians - n * kHalfPiHigh;
  const double middle = n * kHalfPiMiddle;
  const double r0 = high - middle;
  const double low = n * kHalfPiLow - ((high - r0) - middle);
  const double r = r0 - low;
  const double tail = (r0 - r) - low;
  const double s = sin_kernel(r, tail);
  const double c = cos_kernel(r, tail);
  switch (quadrant & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace woodlouse::core
