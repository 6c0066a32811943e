#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "shared/terrain/fill_missing.h"
#include "shared/terrain/outside_policy.h"
#include "shared/terrain/tiled_bspline.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::terrain;

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

bool all_finite(const SurfaceSample& s) {
  return std::isfinite(s.z) && std::isfinite(s.zx) && std::isfinite(s.zy) && std::isfinite(s.zxx) &&
         std::isfinite(s.zxy) && std::isfinite(s.zyy);
}

/// A NaN at knot (20, 10) of a smooth 70 x 40 grid.
HeightGrid grid_with_hole() {
  HeightGrid grid = tests::smooth_grid(70, 40);
  grid.heights[10 * 70 + 20] = kMissing;
  return grid;
}

}  // namespace

TEST_CASE("under kHole exactly the four cells around a knot without data have no ground") {
  const HeightGrid grid = grid_with_hole();
  const TiledBSpline surface(grid);
  tests::at_random_points(grid.domain(), 20000, 3, [&](double x, double y) {
    const auto [column, row] = tests::in_knots(grid, x, y);
    const bool in_hole = column >= 19 && column < 21 && row >= 9 && row < 11;
    INFO(column << ", " << row);
    REQUIRE(surface.has_ground(x, y) == !in_hole);
    REQUIRE(is_ground(surface, x, y) == !in_hole);
    REQUIRE(all_finite(surface.sample(x, y)) == !in_hole);
    REQUIRE(std::isnan(surface.sample(x, y).z) == in_hole);
    REQUIRE(sample_anywhere(surface, x, y, OutsidePolicy::kNothing).has_value() == !in_hole);
  });
}

TEST_CASE("under kFill there is ground everywhere, and the filling is told by has_ground") {
  TiledBSplineOptions options;
  options.no_data = NoDataPolicy::kFill;
  const HeightGrid grid = grid_with_hole();
  const TiledBSpline surface(grid, options);
  tests::at_random_points(grid.domain(), 5000, 3,
                          [&](double x, double y) { REQUIRE(all_finite(surface.sample(x, y))); });
  const double x = grid.x_origin + 19.5 * grid.dx, y = grid.y_origin + 9.5 * grid.dy;
  CHECK_FALSE(surface.has_ground(x, y));
}

TEST_CASE("away from a hole its filling is not felt: by 0.268 a knot less") {
  const HeightGrid whole = tests::smooth_grid(200, 40);
  HeightGrid holed = whole;
  for (std::size_t j = 10; j < 20; ++j)
    std::fill_n(holed.heights.begin() + static_cast<std::ptrdiff_t>(j * 200 + 20), 10, kMissing);
  const TiledBSpline a(whole), b(holed);
  for (int knots = 2; knots < 60; ++knots) {
    const double x = whole.x_origin + (29 + knots) * whole.dx, y = whole.y_origin + 15 * whole.dy + 0.01;
    INFO(knots << " knots from the shore");
    CHECK(std::fabs(a.sample(x, y).z - b.sample(x, y).z) <= std::fmax(10.0 * std::pow(0.268, knots), 1e-13));
  }
}

TEST_CASE("holes over tile lines: neighbours agree on the filling, in any order of visits") {
  HeightGrid grid = tests::smooth_grid(200, 200);
  for (std::size_t j = 40; j < 100; ++j)
    std::fill_n(grid.heights.begin() + static_cast<std::ptrdiff_t>(j * 200 + 50), 25, kMissing);
  TiledBSplineOptions options;
  options.no_data = NoDataPolicy::kFill;
  const TiledBSpline surface(grid, options);
  for (const std::size_t line : {64u, 128u}) {
    const double x = grid.x_origin + static_cast<double>(line) * grid.dx;
    for (double y = 2.3; y < 50.0; y += 0.37) {
      const SurfaceSample west = surface.sample(std::nextafter(x, -1e9), y), east = surface.sample(x, y);
      CHECK(west.z == Approx(east.z).margin(1e-12));
      CHECK(west.zxx == Approx(east.zxx).margin(1e-9));
    }
  }
}

TEST_CASE("a shore just outside a tile's window is filled from all the same: tiles agree on it") {
  // Data end at knot 97; the tile that begins at knot 128 solves from knot 98 on.
  HeightGrid grid = tests::smooth_grid(200, 70);
  for (std::size_t j = 0; j < grid.rows; ++j) {
    std::fill_n(grid.heights.begin() + static_cast<std::ptrdiff_t>(j * 200 + 98), 102, kMissing);
  }
  TiledBSplineOptions options;
  options.no_data = NoDataPolicy::kFill;
  options.fill_level = 100.0;
  const TiledBSpline surface(grid, options);
  const double x = grid.x_origin + 128.0 * grid.dx;
  for (double y = 2.3; y < 19.0; y += 0.37) {
    CHECK(std::fabs(surface.sample(std::nextafter(x, -1e9), y).zx - surface.sample(x, y).zx) < 1e-9);
  }
}

TEST_CASE("filling is the mean of the known neighbours, round by round, and level beyond its reach") {
  std::vector<double> heights(41 * 41, kMissing);
  heights[20 * 41 + 20] = 8.0;
  fill_missing(heights, 41, -5.0);
  CHECK(heights[20 * 41 + 19] == 8.0);
  CHECK(heights[20 * 41 + 4] == 8.0);  // 16 knots away
  for (const std::size_t beyond : {20u * 41 + 37, 3u * 41 + 20, 37u * 41 + 20})
    CHECK(heights[beyond] == -5.0);
  CHECK(heights[20 * 41 + 3] == -5.0);  // 17
  std::vector<double> row{1.0, kMissing, 4.0, std::numeric_limits<double>::infinity()};
  fill_missing(row, 4, 0.0);
  CHECK(row == std::vector<double>{1.0, 2.5, 4.0, 4.0});
}

TEST_CASE("a map without any data has no ground and ends nowhere in an abort") {
  HeightGrid grid = tests::smooth_grid(20, 20);
  std::fill(grid.heights.begin(), grid.heights.end(), kMissing);
  const TiledBSpline surface(grid);
  CHECK_FALSE(surface.has_ground(0.0, 3.0));
  CHECK(std::isnan(surface.sample(0.0, 3.0).zyy));
}
