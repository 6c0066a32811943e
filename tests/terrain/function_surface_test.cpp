#include "shared/terrain/function_surface.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "shared/core/random.h"
#include "shared/terrain/terrain.h"

using namespace woodlouse;
using namespace woodlouse::terrain;

TEST_CASE("each function's gradient and Hessian are the derivatives of its height, at any scale") {
  core::Random random(21);
  for (const FunctionName name : kFunctionNames) {
    for (const double scale : {1.0, 20.0}) {
      const FunctionSurface f(name, scale);
      const double h = 1e-5 * scale;
      for (int i = 0; i < 300; ++i) {
        const double x = scale * (2.0 * random.uniform() - 1.0);
        const double y = scale * (2.0 * random.uniform() - 1.0);
        const SurfaceSample s = f.sample(x, y);
        const SurfaceSample east = f.sample(x + h, y), west = f.sample(x - h, y);
        const SurfaceSample north = f.sample(x, y + h), south = f.sample(x, y - h);
        INFO(to_text(name) << " scale " << scale << " at " << x << ", " << y);
        REQUIRE(s.zx == Approx((east.z - west.z) / (2 * h)).margin(1e-8));
        REQUIRE(s.zy == Approx((north.z - south.z) / (2 * h)).margin(1e-8));
        REQUIRE(s.zxx == Approx((east.zx - west.zx) / (2 * h)).margin(1e-7));
        REQUIRE(s.zxy == Approx((north.zx - south.zx) / (2 * h)).margin(1e-7));
        REQUIRE(s.zyy == Approx((north.zy - south.zy) / (2 * h)).margin(1e-7));
      }
    }
  }
}

TEST_CASE("function names go to text and back") {
  for (const FunctionName name : kFunctionNames) CHECK(function_from_text(to_text(name)) == name);
  CHECK_FALSE(function_from_text("crater").has_value());
}

TEST_CASE("a sampled function has its heights at the knots, south to north and west to east") {
  const HeightGrid grid = sample_function(FunctionName::kHills, 20.0, 5);
  const FunctionSurface f(FunctionName::kHills, 20.0);
  REQUIRE(grid.columns == 11);
  REQUIRE(grid.rows == 11);
  CHECK(grid.at(2, 7) == Approx(f.sample(-20.0 + 2 * 4.0, -20.0 + 7 * 4.0).z).margin(1e-13));
  CHECK(grid.domain() == Rectangle{-20.0, -20.0, 20.0, 20.0});
}

TEST_CASE("sampling a terrain reaches its corners") {
  const Terrain terrain{FunctionSurface(FunctionName::kVolcano, 20.0)};
  const HeightGrid grid = sample_grid(terrain, 7, 4);
  CHECK(grid.at(6, 3) == terrain.sample(20.0, 20.0).z);
  CHECK(grid.at(0, 0) == terrain.sample(-20.0, -20.0).z);
}

TEST_CASE("where a step that went astray may look, a function is finite still, however far") {
  for (const FunctionName name : kFunctionNames) {
    const FunctionSurface f(name, 0.5);
    for (const double far : {1e5, -1e9, 1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
      const SurfaceSample s = f.sample(far, -far);
      for (const double value : {s.z, s.zx, s.zy, s.zxx, s.zxy, s.zyy}) CHECK(std::isfinite(value));
    }
  }
}
