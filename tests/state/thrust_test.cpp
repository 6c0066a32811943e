// A thrust's rounding, from the numbers alone; tests/protocol/thrust_test.cpp sees it from the wire.
#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"
#include "shared/state/thrust.h"

using namespace woodlouse;
using namespace woodlouse::state;

namespace {

bool is_multiple(double value) { return value / kThrustQuantum == std::nearbyint(value / kThrustQuantum); }

}  // namespace

TEST_CASE("a push along the heading is the nearest quantum in [-1, 1]") {
  core::Random random(3);
  for (int round = 0; round < 10000; ++round) {
    const double value = 4.0 * random.uniform() - 2.0;
    const RoundedThrust rounded = rounded_along_heading(value);
    const double kept = std::fmin(1.0, std::fmax(-1.0, value));
    REQUIRE(rounded.thrust.kind == ThrustKind::kAlongHeading);
    REQUIRE(is_multiple(rounded.thrust.value.x));
    REQUIRE(std::abs(rounded.thrust.value.x - kept) <= 0.5 * kThrustQuantum);
    REQUIRE(rounded.clamped == (std::abs(value) >= 1.0 + 0.5 * kThrustQuantum));
  }
}

TEST_CASE("towards zero no vector gets longer, and by less than a quantum shorter each way") {
  core::Random random(4);
  for (int round = 0; round < 10000; ++round) {
    const core::Vec2 value{2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0};
    const core::Vec2 cut = quanta_towards_zero(value);
    REQUIRE(is_multiple(cut.x));
    REQUIRE(is_multiple(cut.y));
    REQUIRE(std::abs(cut.x) <= std::abs(value.x));
    REQUIRE(std::abs(cut.y) <= std::abs(value.y));
    REQUIRE(std::abs(value.x - cut.x) < kThrustQuantum);
    REQUIRE(std::abs(value.y - cut.y) < kThrustQuantum);
  }
  CHECK(std::signbit(quanta_towards_zero({-0.001, 0.0}).x));
}
