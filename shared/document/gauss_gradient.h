// Gauss least squares (chapters 3.2 and 3.4): gradients of fitted quadratics, stored at the knots.
//
// Around each knot  z = a0 + a1 u + a2 v + a3 u^2 + a4 u v + a5 v^2  (u, v in knot spacings from the centre)
// is the least-squares fit to the 3 x 3 heights z[p][q], p, q = -1, 0, 1. The normal equations have
// closed-form weights:
//     a1 = sum_q (z[1][q] - z[-1][q]) / 6
//     a2 = sum_p (z[p][1] - z[p][-1]) / 6
//     a3 = sum_q (z[1][q] - 2 z[0][q] + z[-1][q]) / 6
//     a5 = sum_p (z[p][1] - 2 z[p][0] + z[p][-1]) / 6
//     a4 = (z[1][1] - z[-1][1] - z[1][-1] + z[-1][-1]) / 4
// The knot's gradient is (a1 + 2 a3 p + a4 q, a2 + 2 a5 q + a4 p) at the knot's place (p, q) in its
// neighbourhood: (0, 0), but at the rim, where the neighbourhood's centre moves inward.
// Between knots the gradient is interpolated linearly in each direction ("we can interpolate these normal
// vectors very fast linearly", 3.4); the height is that of Biquadratic. (The text of 3.2 is lost; this is
// what 3.4 and its name say.)
//
// Continuity: gradient C0; height as Biquadratic. The gradient is not the derivative of the height, so there
// is no Hessian.
// Exact on quadratics (total degree 2), up to the rim. Orders: height 3, gradient 2.
// Outside the domain: the edge cell's bilinear gradient and the rim stencil's height go on.
// Memory: 24 bytes a knot. Cost: the height's nine loads and four gradients; about 25 ns.
// Preparation: O(knots).
#pragma once

#include <vector>

#include "shared/core/vec2.h"
#include "shared/document/biquadratic.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::document {

class GaussGradient {
 public:
  static constexpr bool has_hessian = false;

  /// REQUIRES at least 3 knots each way, spacings > 0.
  explicit GaussGradient(terrain::HeightGrid grid);

  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const;
  [[nodiscard]] terrain::Rectangle domain() const { return height_.domain(); }
  [[nodiscard]] double cell() const { return height_.cell(); }
  /// The stored gradient of knot (i, j).
  [[nodiscard]] core::Vec2 knot_gradient(std::size_t i, std::size_t j) const {
    return gradients_[j * height_.grid().columns + i];
  }

 private:
  Biquadratic height_;
  std::vector<core::Vec2> gradients_;
};

}  // namespace woodlouse::document
