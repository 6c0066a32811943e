// Biquadratic interpolation: the polynomial through the nine knots around the nearest one (chapters 3.3 and
// 3.6).
//
// Stencil 3 x 3, see nine_knots.h; the gradient is the polynomial's own. At the rim the stencil's centre
// moves inward.
// Continuity: none halfway between knots, where the stencil changes: the height jumps by h^3 z'''/8 there,
//   the gradient by order h^2. So there is no usable Hessian.
// Exact on biquadratic polynomials, up to the rim. Orders: height 3, gradient 2.
// Outside the domain: the rim stencil's polynomial goes on.
// Memory: 8 bytes a knot. Cost: nine loads, no preparation; about 20 ns.
// NaN knots reach only the points whose stencil holds them (outside_policy.h).
#pragma once

#include <utility>

#include "shared/document/nine_knots.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::document {

class Biquadratic {
 public:
  static constexpr bool has_hessian = false;

  /// REQUIRES at least 3 knots each way, spacings > 0.
  explicit Biquadratic(terrain::HeightGrid grid);

  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const;
  [[nodiscard]] terrain::Rectangle domain() const { return domain_; }
  [[nodiscard]] double cell() const { return grid_.dx < grid_.dy ? grid_.dx : grid_.dy; }
  [[nodiscard]] const terrain::HeightGrid& grid() const { return grid_; }

 private:
  terrain::HeightGrid grid_;
  terrain::Rectangle domain_;
  double inverse_dx_;
  double inverse_dy_;
};

inline terrain::SurfaceSample Biquadratic::sample(double x, double y) const {
  const double column = (x - grid_.x_origin) * inverse_dx_;
  const double row = (y - grid_.y_origin) * inverse_dy_;
  const std::size_t i = nearest_inner_knot(column, grid_.columns);
  const std::size_t j = nearest_inner_knot(row, grid_.rows);
  const StencilSample s =
      nine_knots(grid_, i, j).sample(column - static_cast<double>(i), row - static_cast<double>(j));
  return {s.z,
          s.zu * inverse_dx_,
          s.zv * inverse_dy_,
          terrain::kNoHessian,
          terrain::kNoHessian,
          terrain::kNoHessian};
}

}  // namespace woodlouse::document
