// sin and cos that give the same bits on every machine: + - * and integer conversion only.
//
// Cody-Waite reduction by pi/2 in three parts (33 + 33 + 53 bits), then the odd and even minimax polynomials
// of degree 13 and 14 on [-pi/4, pi/4]. Error below 1 ulp for |x| <= 1e5. libm is no substitute: glibc picks
// FMA variants at run time, so its last bit differs between processors.
#pragma once

namespace woodlouse::core {

struct SinCos {
  double sin;
  double cos;
};

/// sin and cos of `radians`. REQUIRES |radians| <= 1e5.
SinCos portable_sincos(double radians);

}  // namespace woodlouse::core
