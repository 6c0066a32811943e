// Biquadratic interpolation with linear blending (chapters 4.1 to 4.3).
//
// A is the polynomial around the nearest knot, B the one a knot further in x on the point's side, C the one
// in y; dx, dy the offsets from A's knot in knot spacings:
//     z = za + |dx| (zb - za) + |dy| (zc - za)
// Along one axis that is the Catmull-Rom cubic through four knots. Stencil: 4 x 4 knots without the corner
// far from A.
// At the rim the stencils' centres move inward; a neighbour that would not fit is A itself.
//
// The gradient comes in three kinds:
//     kConsistent   the derivative of z:
//                   zx = xa + |dx| (xb - xa) + |dy| (xc - xa) + sign(dx) (zb - za), zy alike
//     kDocument     "the normals are blended as well" (4.3.1): without the last term. It is not the
//                   derivative of z: off by up to 0.009 on wavy_pot and 0.028 on volcano at h = 0.1.
//     kDifferenced  Biquad2 (4.3.5): central differences of z over 0.001 knot spacings each way. The
//                   document's ds is 0.001 times the grid number where 0.001 divided by it is meant; here it
//                   is put right.
// Continuity: z is C1 at knot lines. At the lines halfway, where A changes, z jumps by order h^6 and its
//   gradient by order h^5 (the mixed difference of A, B, C and the fourth neighbour, which the three leave
//   out): little on smooth ground, as much as the heights' mixed sixth differences on rough. Curvature jumps
//   at knot lines. So there is no usable Hessian.
// Exact on biquadratic polynomials, up to the rim. Orders: height 3, gradient 2 (all three kinds).
// Outside the domain: the rim stencil's polynomial goes on.
// Memory: 8 bytes a knot. Cost: three (kDifferenced: fifteen) stencils; about 55 ns (140 ns).
// NaN knots reach only the points whose stencils hold them (outside_policy.h).
#pragma once

#include "shared/document/nine_knots.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::document {

enum class BlendGradient { kConsistent, kDocument, kDifferenced };

/// The three stencils at a point given in knot spacings.
class Blend {
 public:
  Blend(const terrain::HeightGrid& grid, double column, double row);

  [[nodiscard]] double value() const;
  /// zu, zv of kind kConsistent or kDocument.
  template <BlendGradient kKind>
  [[nodiscard]] StencilSample sample() const;

 private:
  NineKnots a_;
  NineKnots b_;
  NineKnots c_;
  double u_;       ///< from A's and C's centre in x
  double v_;       ///< from A's and B's centre in y
  double u_of_b_;  ///< from B's centre in x
  double v_of_c_;  ///< from C's centre in y
};

template <BlendGradient kKind>
class BlendedBiquadratic {
 public:
  static constexpr bool has_hessian = false;

  /// REQUIRES at least 3 knots each way, spacings > 0.
  explicit BlendedBiquadratic(terrain::HeightGrid grid);

  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const;
  [[nodiscard]] terrain::Rectangle domain() const { return domain_; }
  [[nodiscard]] double cell() const { return grid_.dx < grid_.dy ? grid_.dx : grid_.dy; }

 private:
  terrain::HeightGrid grid_;
  terrain::Rectangle domain_;
  double inverse_dx_;
  double inverse_dy_;
};

using Blended = BlendedBiquadratic<BlendGradient::kConsistent>;
using BlendedDocument = BlendedBiquadratic<BlendGradient::kDocument>;
using BlendedDifferenced = BlendedBiquadratic<BlendGradient::kDifferenced>;

extern template class BlendedBiquadratic<BlendGradient::kConsistent>;
extern template class BlendedBiquadratic<BlendGradient::kDocument>;
extern template class BlendedBiquadratic<BlendGradient::kDifferenced>;

}  // namespace woodlouse::document
