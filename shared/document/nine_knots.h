// The biquadratic polynomial through 3 x 3 knots and the choice of the nine: what the document's chapters 3
// and 4 share.
//
//     north  z02 z12 z22        u, v: offsets from the middle knot in knot spacings
//     middle z01 z11 z21        along a row (chapter 3.3): z = z1 + a1 u + a2 u^2,
//     south  z00 z10 z20        a1 = (z2 - z0)/2,  a2 = (z2 + z0)/2 - z1
// The three rows' values are then joined along v by the same formula, and so are their derivatives
// a1 + 2 a2 u; d/dv comes from the three columns. The operations stand in the order of the document's
// optimised code (chapters 3.6.3, 4.3.1).
#pragma once

#include <cassert>
#include <cstddef>

#include "shared/terrain/height_grid.h"

namespace woodlouse::document {

/// The knot nearest to `position` (in knot spacings from the first) among those with a neighbour on either
/// side: at the rim the stencil's centre moves inward. Halves go as Pascal's Round sends them, to the even
/// knot, counted as the document does from the middle one. NaN gives 1. REQUIRES knots >= 3.
inline std::size_t nearest_inner_knot(double position, std::size_t knots) {
  const double last = static_cast<double>(static_cast<long long>(knots) - 2);
  const double inside = position > 1.0 ? (position < last ? position : last) : 1.0;
  const long long below = static_cast<long long>(inside);
  const double fraction = inside - static_cast<double>(below);
  const long long is_odd = (below + static_cast<long long>((knots - 1) / 2)) & 1;
  // Sums of comparisons: a branch here would be a coin's throw at every sample.
  return static_cast<std::size_t>(below + (fraction > 0.5) + ((fraction == 0.5) & is_odd));
}

/// Value and derivatives by u and v, that is per knot spacing.
struct StencilSample {
  double z;
  double zu;
  double zv;
};

/// Nine knots; each pointer is at a row's western one.
struct NineKnots {
  const double* south;
  const double* middle;
  const double* north;

  [[nodiscard]] double value(double u, double v) const {
    return along(along(south[0], south[1], south[2], u), along(middle[0], middle[1], middle[2], u),
                 along(north[0], north[1], north[2], u), v);
  }

  [[nodiscard]] StencilSample sample(double u, double v) const {
    return {value(u, v),
            along(slope(south[0], south[1], south[2], u), slope(middle[0], middle[1], middle[2], u),
                  slope(north[0], north[1], north[2], u), v),
            along(slope(south[0], middle[0], north[0], v), slope(south[1], middle[1], north[1], v),
                  slope(south[2], middle[2], north[2], v), u)};
  }

 private:
  static double along(double z0, double z1, double z2, double t) {
    const double a1 = 0.5 * (z2 - z0);
    const double a2 = a1 + z0 - z1;
    return z1 + (a1 + a2 * t) * t;
  }
  static double slope(double z0, double z1, double z2, double t) {
    const double a1 = 0.5 * (z2 - z0);
    const double a2 = a1 + z0 - z1;
    return a1 + a2 * (2.0 * t);
  }
};

/// The nine knots around knot (i, j). REQUIRES 1 <= i <= columns - 2, 1 <= j <= rows - 2.
inline NineKnots nine_knots(const terrain::HeightGrid& grid, std::size_t i, std::size_t j) {
  assert(i >= 1 && i + 2 <= grid.columns && j >= 1 && j + 2 <= grid.rows);
  const double* middle = grid.heights.data() + j * grid.columns + (i - 1);
  return {middle - grid.columns, middle, middle + grid.columns};
}

}  // namespace woodlouse::document
