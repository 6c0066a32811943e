#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "shared/document/biquadratic.h"
#include "shared/document/blended_biquadratic.h"
#include "shared/document/gauss_gradient.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

TEST_CASE("a NaN knot reaches the local surfaces only as far as their stencils") {
  HeightGrid grid = tests::smooth_grid(70, 40);
  grid.heights[10 * 70 + 20] = std::numeric_limits<double>::quiet_NaN();
  const Biquadratic biquadratic(grid);
  const Blended blended(grid);
  const GaussGradient gauss(grid);
  tests::at_random_points(grid.domain(), 20000, 3, [&](double x, double y) {
    const auto [column, row] = tests::in_knots(grid, x, y);
    const double away = std::fmax(std::fabs(column - 20), std::fabs(row - 10));
    INFO(column << ", " << row);
    REQUIRE(std::isfinite(biquadratic.sample(x, y).z) == (away > 1.5));
    if (away > 2.0) {
      REQUIRE(std::isfinite(blended.sample(x, y).zx));
      REQUIRE(std::isfinite(gauss.sample(x, y).zx));
    }
  });
}
