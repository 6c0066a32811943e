// The document's own evaluation of the global natural spline (chapter 5.4): the baseline that BicubicSpline
// is measured against.
//
// Prepared once (AllSpline, CofSpline): for every row the natural spline along x, four coefficients and the
// height at each knot.
// Each evaluation (ZxySpline, ValSpline) takes the rows' values and x-derivatives at x, builds the natural
// spline along y through them, solves it, and evaluates: O(rows) a point, twice, once for z and zy, once for
// zx:
//     mm[1] = 1/4,  mm[j+1] = 1/(4 - mm[j])
//     yy[j] = 6 (z[j+1] - 2 z[j] + z[j-1]) - yy[j-1] mm[j-1]
//     xx[j] = (yy[j] - xx[j+1]) mm[j]                            the curvatures, natural: xx = 0 at both ends
// Kept as printed, because that is what it costs: vectors of 1001 numbers passed by value, the division table
// mm rebuilt at each evaluation, work arrays of 1002; only the array of row pointers is not copied. Put
// right: nothing; the comment "3 dx c3 + 2 dx c2" in ValSpline is wrong, its code is not. Same numbers as
// BicubicSpline with natural ends, to rounding.
//
// Continuity: C2; but the algorithm yields no second derivatives: has_hessian is false. Orders: 4 and 3
// inside, 2 and 1 at the rim.
// Outside the domain: the edge cell's polynomial goes on.
// Memory: 40 bytes a knot. Cost: 0.4 us at 21 x 21 knots, 4.6 us at 201 x 201, 24 to 34 us at 1001 x 1001.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::document {

class Spline {
 public:
  static constexpr bool has_hessian = false;
  static constexpr std::size_t kMinKnots = 5;     ///< each way: p >= 4
  static constexpr std::size_t kMaxKnots = 1001;  ///< each way: spl + 1

  /// REQUIRES kMinKnots to kMaxKnots each way, spacings > 0, finite heights.
  explicit Spline(const terrain::HeightGrid& grid);

  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const;
  [[nodiscard]] terrain::Rectangle domain() const { return domain_; }
  [[nodiscard]] double cell() const { return dx_ < dy_ ? dx_ : dy_; }

 private:
  /// GridOne: a3 .. a0 of the x-spline from this knot to the next; z the knot's height.
  struct Knot {
    double a3, a2, a1, a0, z;
  };

  terrain::Rectangle domain_;
  double dx_;
  double dy_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<Knot> knots_;
};

}  // namespace woodlouse::document
