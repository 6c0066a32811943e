#include "shared/document/surface_catalogue.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

static_assert(CurvedSurface<BicubicSpline> && CurvedSurface<FunctionSurface> && CurvedSurface<TiledBSpline> &&
              CurvedSurface<WrappedSurface<BicubicSpline>>);
static_assert(Surface<Biquadratic> && !CurvedSurface<Biquadratic>);
static_assert(Surface<Blended> && !CurvedSurface<Blended>);
static_assert(Surface<BlendedDocument> && !CurvedSurface<BlendedDocument>);
static_assert(Surface<BlendedDifferenced> && !CurvedSurface<BlendedDifferenced>);
static_assert(Surface<GaussGradient> && !CurvedSurface<GaussGradient>);
static_assert(Surface<Spline> && !CurvedSurface<Spline>);
static_assert(!CurvedSurface<WrappedSurface<Biquadratic>>);

TEST_CASE("every interpolation goes to text and back, and is built over the four functions") {
  for (const Interpolation interpolation : kInterpolations) {
    CHECK(interpolation_from_text(to_text(interpolation)) == interpolation);
    for (const FunctionName name :
         {FunctionName::kParabolicPot, FunctionName::kWavyPot, FunctionName::kVolcano}) {
      INFO(to_text(interpolation) << " over " << to_text(name));
      CHECK(interpolate(interpolation, sample_function(name, 1.0, 5)).has_value());
    }
  }
  CHECK_FALSE(interpolation_from_text("trilinear").has_value());
}

TEST_CASE("a surface says at run time whether it has a Hessian, and its samples agree") {
  for (const Interpolation interpolation : kInterpolations) {
    const auto surface = interpolate(interpolation, sample_function(FunctionName::kWavyPot, 1.0, 5));
    REQUIRE(surface.has_value());
    const SurfaceSample s = std::visit([](const auto& it) { return it.sample(0.123, -0.321); }, *surface);
    INFO(to_text(interpolation));
    CHECK(std::isfinite(s.zx));
    CHECK(has_hessian(*surface) == std::isfinite(s.zxx));
    CHECK(has_hessian(*surface) == std::isfinite(s.zyy));
  }
}

TEST_CASE("grids that do not fit an interpolation are refused with the reason") {
  const auto refusal = [](Interpolation interpolation, const HeightGrid& grid) {
    const auto surface = interpolate(interpolation, grid);
    return surface.has_value() ? std::string() : surface.error().text();
  };
  CHECK(refusal(Interpolation::kNotAKnot, tests::smooth_grid(3, 9)) ==
        "not_a_knot: needs 4 knots each way (take a finer grid)");
  CHECK(refusal(Interpolation::kNaturalDocument, tests::smooth_grid(1002, 5)).find("at most 1001") !=
        std::string::npos);
  CHECK(refusal(Interpolation::kPeriodic, sample_function(FunctionName::kHills, 1.0, 5))
            .find("differs from the first") != std::string::npos);
  HeightGrid holed = tests::smooth_grid(9, 9);
  holed.heights[3 * 9 + 2] = std::nan("");
  CHECK(refusal(Interpolation::kNatural, holed).find("knot (2, 3) has no height") != std::string::npos);
  CHECK(refusal(Interpolation::kBSpline, holed).empty());
  CHECK(refusal(Interpolation::kBiquadratic, holed).empty());
}
