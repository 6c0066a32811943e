#include "shared/terrain/outside_policy.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "shared/document/surface_catalogue.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

namespace {

AnySurface build(Interpolation interpolation) {
  HeightGrid grid = sample_function(FunctionName::kWavyPot, 1.0, 10);
  auto surface = interpolate(interpolation, grid);
  REQUIRE(surface.has_value());
  return std::move(*surface);
}

}  // namespace

TEST_CASE(
    "1e-16 outside the domain is as good as the edge under kExtend, and nothing under kNothing, on every "
    "surface") {
  for (const Interpolation interpolation : kInterpolations) {
    INFO(to_text(interpolation));
    std::visit(
        [&]<typename S>(const S& surface) {
          for (const double side : {-1.0, 1.0}) {
            const double edge = side, beyond = std::nextafter(edge, 2.0 * side);
            const SurfaceSample at = surface.sample(edge, 0.3);
            const auto past = sample_anywhere(surface, beyond, 0.3, OutsidePolicy::kExtend);
            REQUIRE(past.has_value());
            CHECK(past->z == Approx(at.z).margin(1e-14));
            CHECK(past->zx == Approx(at.zx).margin(1e-11));
            CHECK(sample_anywhere(surface, edge, 0.3, OutsidePolicy::kNothing).has_value());
            const bool wraps = std::is_same_v<S, WrappedSurface<BicubicSpline>>;
            CHECK(sample_anywhere(surface, beyond, 0.3, OutsidePolicy::kNothing).has_value() == wraps);
          }
        },
        build(interpolation));
  }
}

TEST_CASE("a sample outside continues the edge's polynomial: it is never the edge's height held fast") {
  for (const Interpolation interpolation : kInterpolations) {
    if (interpolation == Interpolation::kPeriodic) continue;
    INFO(to_text(interpolation));
    std::visit(
        [&](const auto& surface) {
          // wavy_pot rises outwards at its edge: z(1.02) - z(1) is 0.02 to first order.
          const double step = surface.sample(1.02, 0.3).z - surface.sample(1.0, 0.3).z;
          CHECK(step == Approx(0.02).epsilon(0.25));
        },
        build(interpolation));
  }
}

TEST_CASE("no number aborts: far, infinite and NaN points have no sample") {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const Interpolation interpolation : kInterpolations) {
    INFO(to_text(interpolation));
    std::visit(
        [&](const auto& surface) {
          for (const OutsidePolicy policy : {OutsidePolicy::kExtend, OutsidePolicy::kNothing}) {
            CHECK_FALSE(sample_anywhere(surface, 1e300, 0.0, policy).has_value());
            CHECK_FALSE(sample_anywhere(surface, 0.0, -kInf, policy).has_value());
            CHECK_FALSE(sample_anywhere(surface, std::nan(""), 0.0, policy).has_value());
          }
          CHECK(sample_anywhere(surface, 100.0, 0.0, OutsidePolicy::kExtend).has_value());
        },
        build(interpolation));
  }
}
