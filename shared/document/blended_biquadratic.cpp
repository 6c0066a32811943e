#include "shared/document/blended_biquadratic.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace woodlouse::document {
namespace {

/// The centre next to `center` on the side of `offset`, as far as the grid has one with neighbours.
std::size_t neighbour(std::size_t center, double offset, std::size_t knots) {
  if (offset > 0.0) return std::min(center + 1, knots - 2);
  return std::max<std::size_t>(center - 1, 1);
}

constexpr double kDifferenceStep = 0.001;  ///< [knot spacings], chapter 4.3.5

}  // namespace

Blend::Blend(const terrain::HeightGrid& grid, double column, double row) {
  const std::size_t i = nearest_inner_knot(column, grid.columns);
  const std::size_t j = nearest_inner_knot(row, grid.rows);
  u_ = column - static_cast<double>(i);
  v_ = row - static_cast<double>(j);
  const std::size_t i_of_b = neighbour(i, u_, grid.columns);
  const std::size_t j_of_c = neighbour(j, v_, grid.rows);
  u_of_b_ = column - static_cast<double>(i_of_b);
  v_of_c_ = row - static_cast<double>(j_of_c);
  a_ = nine_knots(grid, i, j);
  b_ = nine_knots(grid, i_of_b, j);
  c_ = nine_knots(grid, i, j_of_c);
}

double Blend::value() const {
  const double za = a_.value(u_, v_);
  const double zb = b_.value(u_of_b_, v_);
  const double zc = c_.value(u_, v_of_c_);
  return za + std::fabs(u_) * (zb - za) + std::fabs(v_) * (zc - za);
}

template <BlendGradient kKind>
StencilSample Blend::sample() const {
  const StencilSample a = a_.sample(u_, v_);
  const StencilSample b = b_.sample(u_of_b_, v_);
  const StencilSample c = c_.sample(u_, v_of_c_);
  const double weight_b = std::fabs(u_);
  const double weight_c = std::fabs(v_);
  StencilSample s{a.z + weight_b * (b.z - a.z) + weight_c * (c.z - a.z),
                  a.zu + weight_b * (b.zu - a.zu) + weight_c * (c.zu - a.zu),
                  a.zv + weight_b * (b.zv - a.zv) + weight_c * (c.zv - a.zv)};
  if constexpr (kKind == BlendGradient::kConsistent) {
    s.zu += u_ > 0.0 ? b.z - a.z : a.z - b.z;
    s.zv += v_ > 0.0 ? c.z - a.z : a.z - c.z;
  }
  return s;
}

template <BlendGradient kKind>
BlendedBiquadratic<kKind>::BlendedBiquadratic(terrain::HeightGrid grid)
    : grid_(std::move(grid)),
      domain_(grid_.domain()),
      inverse_dx_(1.0 / grid_.dx),
      inverse_dy_(1.0 / grid_.dy) {
  assert(grid_.columns >= 3 && grid_.rows >= 3 && grid_.dx > 0.0 && grid_.dy > 0.0);
  assert(grid_.heights.size() == grid_.columns * grid_.rows);
}

template <BlendGradient kKind>
terrain::SurfaceSample BlendedBiquadratic<kKind>::sample(double x, double y) const {
  const double column = (x - grid_.x_origin) * inverse_dx_;
  const double row = (y - grid_.y_origin) * inverse_dy_;
  StencilSample s;
  if constexpr (kKind == BlendGradient::kDifferenced) {
    const auto value = [this](double at_column, double at_row) {
      return Blend(grid_, at_column, at_row).value();
    };
    constexpr double kPerStep = 0.5 / kDifferenceStep;
    s = {value(column, row),
         kPerStep * (value(column + kDifferenceStep, row) - value(column - kDifferenceStep, row)),
         kPerStep * (value(column, row + kDifferenceStep) - value(column, row - kDifferenceStep))};
  } else {
    s = Blend(grid_, column, row).template sample<kKind>();
  }
  return {s.z,
          s.zu * inverse_dx_,
          s.zv * inverse_dy_,
          terrain::kNoHessian,
          terrain::kNoHessian,
          terrain::kNoHessian};
}

template class BlendedBiquadratic<BlendGradient::kConsistent>;
template class BlendedBiquadratic<BlendGradient::kDocument>;
template class BlendedBiquadratic<BlendGradient::kDifferenced>;

}  // namespace woodlouse::document
