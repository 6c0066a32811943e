#include "shared/terrain/plane_surface.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"
#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/terrain.h"

using namespace woodlouse;
using namespace woodlouse::terrain;

namespace {

/// Heights as a map's author writes them: each rounded by itself.
HeightGrid inclined(double height, double slope_x, double slope_y) {
  HeightGrid grid{9, 7, -3.0, 1.0, 0.7, 0.3, {}};
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      grid.heights.push_back(height + slope_x * (static_cast<double>(i) * grid.dx) +
                             slope_y * (static_cast<double>(j) * grid.dy));
    }
  }
  return grid;
}

}  // namespace

TEST_CASE("the plane through a grid's heights is the spline through them") {
  core::Random random(4);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  for (int turn = 0; turn < 200; ++turn) {
    const double height = turn % 4 == 0 ? 0.0 : symmetric(1000.0);
    const core::Vec2 slope = turn % 5 == 0 ? core::Vec2{} : core::Vec2{symmetric(3.0), symmetric(3.0)};
    const HeightGrid grid = inclined(height, slope.x, slope.y);
    const auto plane = plane_through(grid);
    REQUIRE(plane);
    CHECK(plane->domain() == grid.domain());
    CHECK(std::isinf(plane->cell()));
    const BicubicSpline spline(grid);
    const Terrain terrain(*plane);
    const double size = std::abs(height) + 20.0;
    for (int i = 0; i < 20; ++i) {
      const double x = -3.0 + 5.6 * random.uniform();
      const double y = 1.0 + 1.8 * random.uniform();
      const SurfaceSample of_spline = spline.sample(x, y);
      const SlopeSample of_plane = plane->sample(x, y);
      CHECK(std::abs(of_plane.z - of_spline.z) <= 1e-14 * size);
      CHECK(std::abs(of_plane.zx - of_spline.zx) <= 1e-13 * size);
      CHECK(std::abs(of_plane.zy - of_spline.zy) <= 1e-13 * size);
      const SurfaceSample of_terrain = terrain.sample(x, y);
      CHECK(of_terrain.z == of_plane.z);
      CHECK(of_terrain.zx == of_plane.zx);
      CHECK(of_terrain.zxx == 0.0);
      CHECK(of_terrain.zxy == 0.0);
      CHECK(of_terrain.zyy == 0.0);
    }
  }
}

TEST_CASE("level ground is that height exactly, wherever one looks") {
  const auto plane = plane_through(inclined(0.1, 0.0, 0.0));
  REQUIRE(plane);
  CHECK(plane->sample(0.3, 1.7).z == 0.1);
  CHECK(plane->sample(-1e6, 1e6).z == 0.1);
  CHECK(plane->slope() == core::Vec2{});
}

TEST_CASE("one knot that lies off the others' plane makes it none") {
  const HeightGrid flat = inclined(2.0, 0.4, -0.3);
  REQUIRE(plane_through(flat));
  for (std::size_t knot = 0; knot < flat.heights.size(); ++knot) {
    for (const double off : {1e-12, -1e-3, 1.0}) {
      HeightGrid dented = flat;
      dented.heights[knot] += off;
      CHECK_FALSE(plane_through(dented));
    }
  }
}
