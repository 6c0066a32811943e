// Coefficients of the uniform cubic B-spline with not-a-knot ends, many lines at once.
//
// Through values z[0] .. z[n-1] at spacing 1 goes  s(x) = sum c[i] B(x - i), i = -1 .. n, B the cardinal
// cubic B-spline:
//     c[i-1] + 4 c[i] + c[i+1] = 6 z[i],  i = 0 .. n-1
// Not-a-knot: the fourth differences of c around knots 1 and n-2 are zero, which gives at once
//     c[1] = (8 z[1] - z[0] - z[2]) / 6,  c[n-2] alike
// so c[2] .. c[n-3] solve a tridiagonal system with known ends, and c[0], c[-1], c[n-1], c[n] follow.
// It is the same spline as spline_1d.h's not-a-knot one. A change of z (or of the ends' rule) at knot i
// reaches c[i + k] with a factor of about 0.268^k = (sqrt(3) - 2)^k: 1e-16 after 28 knots.
#pragma once

#include <cstddef>
#include <span>

namespace woodlouse::terrain {

/// `lanes` independent lines of n = values.size() / lanes values, interleaved: values[k * lanes + lane].
/// Writes c[-1] .. c[n] of each, n + 2 times lanes numbers, interleaved alike. REQUIRES n >= 4. O(n lanes).
void bspline_coefficients(std::span<const double> values, std::size_t lanes, std::span<double> coefficients);

}  // namespace woodlouse::terrain
