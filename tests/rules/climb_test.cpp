#include "shared/rules/climb.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>

#include "shared/map/map_text.h"

using namespace woodlouse;
using namespace woodlouse::rules;

namespace {

/// 40 m by 20 m whose columns of knots, 5 m apart, have these heights: the same from south to north.
std::shared_ptr<const map::Map> slopes(const std::string& columns, const std::string& edges = "walls") {
  std::string rows;
  for (int row = 0; row < 5; ++row) rows += (row ? ",[" : "[") + columns + "]";
  const auto map =
      map::parse_map(R"({"name":"m","terrain":{"spacing":5,"heights":[)" + rows + R"(]},"edges":")" + edges +
                         R"(","spawns":[{"position":[-17,0]}],)"
                         R"("race":{"gates":[{"a":[-15,4],"b":[-15,-4]},{"a":[15,4],"b":[15,-4]}]}})",
                     "m.json", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

}  // namespace

TEST_CASE("the slope that a thrust climbs is that of the maps' description") {
  state::Parameters physics;
  CHECK(climbable_slope(physics) == Approx(0.39).margin(0.005));
  physics.thrust_max = 6.0;
  CHECK(climbable_slope(physics) == Approx(0.69).margin(0.005));
  physics.gravity = 4.0;
  CHECK(climbable_slope(physics) >= 100.0);
}

TEST_CASE("run-ups are as long as what is too steep on the straight ways from gate to gate and back") {
  CHECK(length_of_run_ups(*slopes("0,0,0,0,0,0,0,0,0")) == 0.0);
  // A slope of 0.3 is climbed; one of 0.6 is not, whichever way: it is up on the way there or on that back.
  CHECK(length_of_run_ups(*slopes("0,1.5,3,4.5,6,7.5,9,10.5,12")) == 0.0);
  CHECK(length_of_run_ups(*slopes("0,3,6,9,12,15,18,21,24")) == Approx(30.0));
  CHECK(length_of_run_ups(*slopes("24,21,18,15,12,9,6,3,0")) == Approx(30.0));
}

TEST_CASE("where edges wrap, the way to the next gate is the nearest one") {
  // The hill is in the middle; the gates are 10 m apart over the seam, and 30 m over it.
  const std::string hill = "0,0,0,4,8,4,0,0,0";
  CHECK(length_of_run_ups(*slopes(hill)) > 5.0);
  CHECK(length_of_run_ups(*slopes(hill, "wrap")) < 1.0);
}

TEST_CASE("past the edge the ground is that of the edge, and of the other side where edges wrap") {
  const auto walls = slopes("0,1.5,3,4.5,6,7.5,9,10.5,12");
  CHECK(ground_at(*walls, images_of(*walls), {25.0, 0.0}).z == Approx(12.0));
  const auto wraps = slopes("0,0,0,4,8,4,0,0,0", "wrap");
  CHECK(ground_at(*wraps, images_of(*wraps), {40.0, 0.0}).z == Approx(8.0));
  // The last places before a seam, and those images of it that rounding puts beside it.
  for (const double turns : {-3.0, -1.0, 0.0, 1.0, 2.0, 7.0}) {
    for (const double towards : {-1e9, 1e9}) {
      const core::Vec2 seam{20.0 + turns * 40.0, 10.0 + turns * 20.0};
      const core::Vec2 beside{std::nextafter(seam.x, towards), std::nextafter(seam.y, towards)};
      CHECK(ground_at(*wraps, images_of(*wraps), beside).z == Approx(0.0).margin(1e-9));
    }
  }
}
