#include "shared/document/gauss_gradient.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

namespace {

/// The knot's gradient by a QR factorisation of the nine equations in six unknowns.
core::Vec2 fitted_by_qr(const HeightGrid& grid, std::size_t i, std::size_t j) {
  const std::size_t ci = std::clamp<std::size_t>(i, 1, grid.columns - 2),
                    cj = std::clamp<std::size_t>(j, 1, grid.rows - 2);
  Eigen::Matrix<double, 9, 6> equations;
  Eigen::Matrix<double, 9, 1> heights;
  for (int k = 0; k < 9; ++k) {
    const int p = k % 3 - 1, q = k / 3 - 1;
    equations.row(k) << 1, p, q, p * p, p * q, q * q;
    heights(k) = grid.at(ci + static_cast<std::size_t>(p + 1) - 1, cj + static_cast<std::size_t>(q + 1) - 1);
  }
  const Eigen::Matrix<double, 6, 1> a = equations.colPivHouseholderQr().solve(heights);
  const double p = static_cast<double>(i) - static_cast<double>(ci),
               q = static_cast<double>(j) - static_cast<double>(cj);
  return {(a(1) + 2 * a(3) * p + a(4) * q) / grid.dx, (a(2) + a(4) * p + 2 * a(5) * q) / grid.dy};
}

}  // namespace

TEST_CASE(
    "the closed-form weights are the least-squares fit that Eigen's QR finds, rim and corners included") {
  const HeightGrid grid = tests::random_grid(8, 6, 17);
  const GaussGradient surface(grid);
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const core::Vec2 exact = fitted_by_qr(grid, i, j);
      INFO("knot " << i << ", " << j);
      CHECK(surface.knot_gradient(i, j).x == Approx(exact.x).margin(1e-12));
      CHECK(surface.knot_gradient(i, j).y == Approx(exact.y).margin(1e-12));
    }
  }
}

TEST_CASE("the Gauss gradient is exact on quadratics, up to the rim") {
  const GaussGradient surface(tests::grid_of(
      7, 5, [](double x, double y) { return 0.3 - x + 2 * y + 0.4 * x * x - 0.9 * x * y + 0.25 * y * y; }));
  tests::at_random_points(surface.domain(), 500, 1, [&](double x, double y) {
    const SurfaceSample s = surface.sample(x, y);
    REQUIRE(s.z == Approx(0.3 - x + 2 * y + 0.4 * x * x - 0.9 * x * y + 0.25 * y * y).margin(1e-12));
    REQUIRE(s.zx == Approx(-1 + 0.8 * x - 0.9 * y).margin(1e-11));
    REQUIRE(s.zy == Approx(2 - 0.9 * x + 0.5 * y).margin(1e-11));
  });
}

TEST_CASE("the Gauss gradient is continuous, the height is the biquadratic's") {
  const HeightGrid grid = tests::random_grid(9, 9, 4);
  const GaussGradient surface(grid);
  const Biquadratic biquadratic(grid);
  const double e = 1e-12;
  for (double x = -1.45; x < 2.4; x += 0.25) {
    for (double y = 2.3; y < 4.2; y += 0.0625) {
      CHECK(surface.sample(x - e, y).zx == Approx(surface.sample(x + e, y).zx).margin(1e-10));
      CHECK(surface.sample(x, y - e).zy == Approx(surface.sample(x, y + e).zy).margin(1e-10));
      CHECK(surface.sample(x, y).z == biquadratic.sample(x, y).z);
    }
  }
}
