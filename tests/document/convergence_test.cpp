// Orders of convergence: the slope of log error over log spacing, fitted through several grids.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "shared/document/surface_catalogue.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

namespace {

struct Errors {
  double z = 0.0;
  double gradient = 0.0;
};

/// sin and cos of 2 pi x and 2 pi y: smooth and periodic on [-1, 1]^2.
SurfaceSample waves(double x, double y) {
  constexpr double k = 6.283185307179586;
  const double sx = std::sin(k * x + 0.3), cx = std::cos(k * x + 0.3), sy = std::sin(k * y - 0.8),
               cy = std::cos(k * y - 0.8);
  return {sx * cy, k * cx * cy, -k * sx * sy, 0, 0, 0};
}

HeightGrid wave_grid(std::size_t grid) {
  HeightGrid result = sample_function(FunctionName::kParabolicPot, 1.0, grid);
  const std::size_t side = result.columns;
  for (std::size_t j = 0; j < side; ++j) {
    for (std::size_t i = 0; i < side; ++i) {
      result.heights[j * side + i] = waves(-1.0 + static_cast<double>(i % (side - 1)) * result.dx,
                                           -1.0 + static_cast<double>(j % (side - 1)) * result.dy)
                                         .z;
    }
  }
  return result;
}

Errors worst_errors(Interpolation interpolation, std::size_t grid, double half_side) {
  const auto built = interpolate(interpolation, wave_grid(grid));
  REQUIRE(built.has_value());
  Errors worst;
  std::visit(
      [&](const auto& surface) {
        tests::at_random_points(
            {-half_side, -half_side, half_side, half_side}, 20000, 77, [&](double x, double y) {
              const SurfaceSample s = surface.sample(x, y), exact = waves(x, y);
              worst.z = std::fmax(worst.z, std::fabs(s.z - exact.z));
              worst.gradient = std::fmax(worst.gradient, std::hypot(s.zx - exact.zx, s.zy - exact.zy));
            });
      },
      *built);
  return worst;
}

/// The least-squares slope of log2(error) over log2(h).
double fitted(const std::vector<double>& h, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(h.size());
  for (std::size_t k = 0; k < h.size(); ++k) {
    const double x = std::log2(h[k]), y = std::log2(error[k]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void check_orders(Interpolation interpolation, double half_side, double of_z, double of_gradient) {
  std::vector<double> h, z, gradient;
  for (const std::size_t grid : {16u, 24u, 32u, 48u, 64u}) {
    const Errors errors = worst_errors(interpolation, grid, half_side);
    h.push_back(1.0 / static_cast<double>(grid));
    z.push_back(errors.z);
    gradient.push_back(errors.gradient);
  }
  INFO(to_text(interpolation) << " within " << half_side);
  CHECK(fitted(h, z) == Approx(of_z).margin(0.3));
  CHECK(fitted(h, gradient) == Approx(of_gradient).margin(0.3));
}

}  // namespace

TEST_CASE(
    "splines converge with order 4 in the height and 3 in the gradient, natural ends lose two of each at the "
    "rim") {
  check_orders(Interpolation::kNotAKnot, 1.0, 4.0, 3.0);
  check_orders(Interpolation::kBSpline, 1.0, 4.0, 3.0);
  check_orders(Interpolation::kPeriodic, 1.0, 4.0, 3.0);
  check_orders(Interpolation::kNatural, 0.5, 4.0, 3.0);
  check_orders(Interpolation::kNaturalDocument, 0.5, 4.0, 3.0);
  check_orders(Interpolation::kNatural, 1.0, 2.0, 1.0);
}

TEST_CASE(
    "the biquadratic and its blends converge with order 3 in the height and 2 in the gradient, up to the "
    "rim") {
  check_orders(Interpolation::kBiquadratic, 1.0, 3.0, 2.0);
  check_orders(Interpolation::kBlended, 1.0, 3.0, 2.0);
  check_orders(Interpolation::kBlendedDocument, 1.0, 3.0, 2.0);
  check_orders(Interpolation::kBlendedDifferenced, 1.0, 3.0, 2.0);
  check_orders(Interpolation::kGauss, 1.0, 3.0, 2.0);
}
