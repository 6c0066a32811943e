// A thrust along the heading: the law that turns it, its order, and what walls and ends do to it.
#include "shared/physics/heading.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "shared/physics/nystrom.h"
#include "shared/terrain/function_surface.h"
#include "tests/support/motion.h"

namespace woodlouse::physics {
namespace {

using tests::moving;

state::Louse driven(core::Vec2 velocity, core::Vec2 heading, double thrust = 1.0) {
  state::Louse louse = moving({0, 0}, velocity);
  louse.heading = heading;
  louse.thrust = {thrust, 0.0};
  louse.thrust_kind = state::ThrustKind::kAlongHeading;
  louse.thrust_ticks = state::kHeld;
  return louse;
}

core::Vec2 place_after(const tests::Plane& plane, const state::Parameters& p, const state::Louse& louse,
                       double rate, double seconds) {
  return tests::run<Forces<true, true, true>>(plane, p, louse, rate, std::lround(seconds * rate))
      .louse.position;
}

double apart(core::Vec2 a, core::Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

TEST_CASE("with a constant velocity tan(angle / 2) decays with the way over L") {
  core::Vec2 heading{std::cos(2.5), std::sin(2.5)};
  const core::Vec2 velocity{1.5, 0.0};
  constexpr double kStep = 1.0 / 60;
  Motion at{{0, 0}, velocity};
  for (int i = 1; i <= 60; ++i) {
    const auto flat = [](core::Vec2) { return terrain::SlopeSample{}; };
    const auto no_force = [](const auto&, core::Vec2, core::Vec2) { return core::Vec2{}; };
    const auto no_gain = [](const auto&, core::Vec2, const Motion&) { return Gain{}; };
    const StepResult step = nystrom4_turning(at, heading, {}, kStep, flat, no_force, no_gain);
    heading = step.heading;
    at = step.end;
    const double decayed = std::tan(1.25) * std::exp(-1.5 * i * kStep / kHeadingLength);
    CHECK(std::atan2(heading.y, heading.x) == Approx(2 * std::atan(decayed)).margin(2e-6));
  }
}

TEST_CASE("from rest across a slope a thrust along the heading is of order 4") {
  const tests::Plane plane{{}, 0.3, -0.1};
  const state::Parameters p{9.81, 0.1, 0.0, 4.0, 0.5};
  const state::Louse louse = driven({0, 0}, {0.6, 0.8});
  const core::Vec2 right = place_after(plane, p, louse, 7680, 2);
  double before = 0.0;
  for (const double rate : {30.0, 60.0, 120.0, 240.0}) {
    const double error = apart(place_after(plane, p, louse, rate, 2), right);
    INFO(rate << " Hz: " << error << " m");
    if (rate == 60.0) CHECK(error < 1e-5);
    if (rate > 60.0) CHECK(error < before / 10.0);  // 16 to the letter
    before = error;
  }
}

TEST_CASE("rolling backwards the heading is in a balance that does not last, and the rate hardly matters") {
  const tests::Plane level;
  const state::Parameters p{9.81, 0.0, 0.0, 1.0, 0.5};
  const auto opposed = [](double angle) { return driven({-3, 0}, {std::cos(angle), std::sin(angle)}, 0.5); };
  // Exactly opposed it stays so; beside it the angle grows by e for each L of way, the error of a rate alike.
  const auto straight = tests::run<Forces<true, true, true>>(level, p, opposed(0.0), 60, 120);
  CHECK(straight.louse.position.y == 0.0);
  const core::Vec2 coarse = place_after(level, p, opposed(1e-3), 60, 2);
  const core::Vec2 fine = place_after(level, p, opposed(1e-3), 1000, 2);
  CHECK(apart(coarse, fine) < 1e-3 * apart(fine, straight.louse.position) + 1e-5);
}

TEST_CASE("a louse whose sub-steps are capped turns its heading on as much way as another") {
  // A gutter so narrow that its bottom asks for shorter steps than there are, and bends nobody on it.
  const tests::Gutter gutter{{}, 1e4};
  const state::Parameters p{9.81, 0.0, 0.0, 1e-9, 0.5};
  for (const double angle : {0.5, 2.5, 3.1}) {
    const state::Louse louse = driven({0, 1.5}, {std::sin(angle), std::cos(angle)});
    const auto run = tests::run<Forces<true, true, true>>(gutter, p, louse, 60, 1);
    CHECK(run.counters.capped == run.counters.sub_steps);
    const double left = 2 * std::atan(std::tan(angle / 2) * std::exp(-1.5 / 60 / kHeadingLength));
    CHECK(std::atan2(run.louse.heading.x, run.louse.heading.y) == Approx(left).margin(1e-4));
  }
  CHECK(lagging_heading({0, -1}, {0, 1e140}, 1.0) == core::Vec2{0, 1});
  CHECK(lagging_heading({0, -1}, {0, kHeadingLength}, 1.0) == core::Vec2{0, -1});  // in between lies nothing
}

TEST_CASE("a wall throws the heading back as it does the velocity, and at rest it is kept") {
  const tests::Plane level;
  const state::Parameters p{9.81, 0.0, 0.0, 0.5, 1.0};
  state::Louse louse = driven({4, 1}, {4 / std::sqrt(17.0), 1 / std::sqrt(17.0)}, 0.25);
  const auto run = tests::run<Forces<true, true, true>>(level, p, louse, 60, 20, {-1, -50, 1, 50},
                                                        [](const state::Louse&) { return true; });
  CHECK(run.counters.bounces == 1);
  CHECK(run.louse.heading.x < -0.9);
  CHECK(dot(run.louse.heading, run.louse.heading) == Approx(1.0).epsilon(1e-12));

  const state::Parameters rough{9.81, 0.0, 0.5, 1.0, 0.5};
  const auto held = tests::run<Forces<true, true, true>>(level, rough, driven({0, 0}, {0.6, -0.8}), 60, 100);
  CHECK(held.louse.phase == state::Phase::kResting);
  CHECK(held.louse.heading == core::Vec2{0.6, -0.8});
}

TEST_CASE("braked to rest by friction against its drive, a louse looks the same way at any rate") {
  const tests::Plane plane{{}, 0.2, 0.0};
  const state::Parameters p{9.81, 0.0, 0.6, 1.0, 0.5};
  std::vector<core::Vec2> headings;
  for (const double rate : {15.0, 60.0, 1000.0}) {
    const auto run = tests::run<Forces<true, true, true>>(plane, p, driven({0.5, 1.0}, {-1, 0}), rate,
                                                          std::lround(5 * rate));
    REQUIRE(run.louse.phase == state::Phase::kResting);
    headings.push_back(run.louse.heading);
  }
  CHECK(apart(headings[0], headings[2]) < 1e-3);
  CHECK(apart(headings[1], headings[2]) < 1e-3);
}

TEST_CASE("a louse whose speed is next to nothing keeps a heading of length 1") {
  // The middle of a core that no step resolves: what it may have of energy is next to nothing.
  state::Parameters p{.gravity = 0.0, .drag = 0.015625, .friction = 3.0517578125e-05, .thrust_max = 0.0};
  p.central_gravity = 0.062255859375;
  p.core_radius = 0.001;
  const terrain::FunctionSurface ground(terrain::FunctionName::kWaves, 0.1);
  state::Louse louse = tests::moving({1.0614110704363165e-99, -3.798340216381364e-99},
                                     {2.5086082449583777e-94, 3.0013065898282845e-94});
  louse.heading = {0.6413181838933792, 0.7672750400004535};
  const auto after = tests::run<Forces<true, true, true, true>>(ground, p, louse, 33, 1);
  CHECK(std::hypot(after.louse.heading.x, after.louse.heading.y) == Approx(1.0).epsilon(1e-12));
}

}  // namespace woodlouse::physics
