#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::FunctionName;
using terrain::FunctionSurface;
using terrain::Terrain;
using tests::moving;

TEST_CASE("a slow sideways drift in a gutter that is too steep for friction does not stop") {
  // Across the steep side wall of a gutter, friction can't hold: the speed passes a minimum and the louse
  // turns downhill.
  tests::Gutter gutter;
  core::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const state::Parameters p{.gravity = 9.81, .drag = 0.1, .friction = 0.2};
    const double x = 0.25 + 0.5 * random.uniform();  // slope 0.25 and more, above mu
    const state::Louse start = moving({x, 0}, {0.3 * random.uniform(), 0.05 * random.uniform() - 0.025});
    const auto end = tests::run<Forces<true, true, false>>(gutter, p, start, 60, 60);
    INFO("run " << i);
    CHECK(end.counters.stops == 0);
    CHECK(end.louse.position.x < x);
  }
}

TEST_CASE("pushed below the threshold at each of a million ticks, a louse moves exactly 0.0") {
  tests::Plane plane;
  plane.slope_x = 0.04;
  const state::Parameters p{.gravity = 9.81, .drag = 0.2, .friction = 0.05, .thrust_max = 0.08};
  using F = Forces<true, true, true>;
  const Stepper<tests::Plane, F> stepper(plane, p, tests::kNowhere, 1.0 / 60);
  state::Louse louse = moving({0.3, -0.7}, {});
  StepCounters counters;
  core::Random random(5);
  for (int i = 0; i < 1'000'000; ++i) {
    const double tx = random.uniform() - 0.5, ty = random.uniform() - 0.5;
    louse.thrust = {tx, ty};
    louse.thrust_kind = state::ThrustKind::kMapVector;
    louse.phase = state::Phase::kMoving;  // so that sleeping can't hide it
    StepEvents happened = 0;
    stepper.advance(louse, counters, happened);
    if (louse.phase != state::Phase::kResting) break;
  }
  CHECK(counters.louse_steps == 1'000'000);
  CHECK(louse.position == core::Vec2{0.3, -0.7});
  CHECK(louse.velocity == core::Vec2{});
}

TEST_CASE("a louse is not put to sleep at a pendulum's turning point") {
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.02};
  const tests::Bowl bowl;
  bool slept_early = false;
  const auto run = tests::run<Forces<false, true, false>>(
      bowl, p, moving({0.8, 0}, {}), 60, 60000, tests::kNowhere, [&](const state::Louse& l) {
        // It may only rest where the slope is below mu.
        if (l.phase == state::Phase::kResting && std::hypot(l.position.x, l.position.y) > 0.02)
          slept_early = true;
        return true;
      });
  CHECK_FALSE(slept_early);
  CHECK(run.louse.phase == state::Phase::kResting);
}

TEST_CASE("no louse creeps where friction can hold it: pushed off anywhere, all of them rest in the end") {
  for (const FunctionName name : terrain::kFunctionNames) {
    const FunctionSurface f(name, 20.0);
    for (const double friction : {0.02, 0.05, 0.3}) {
      core::Random random(9);
      const auto symmetric = [&](double size) { return size * (2 * random.uniform() - 1); };
      const state::Parameters p{.gravity = 9.81, .drag = 0.2, .friction = friction, .thrust_max = 0.0};
      for (int i = 0; i < 12; ++i) {
        const auto run = tests::run<Forces<true, true, false>>(
            f, p, moving({symmetric(18), symmetric(18)}, {symmetric(3), symmetric(3)}), 60, 60 * 240,
            f.domain(), [](const state::Louse& l) { return l.phase == state::Phase::kMoving; });
        INFO(terrain::to_text(name) << ", friction " << friction << ", louse " << i << ", speed "
                                    << std::hypot(run.louse.velocity.x, run.louse.velocity.y));
        CHECK(run.louse.phase == state::Phase::kResting);
        CHECK(run.counters.sub_steps < 4 * run.counters.louse_steps + 600);
      }
    }
  }
}

TEST_CASE("a fast louse, whose friction grows with the ground's curvature, is not put to rest") {
  const FunctionSurface bowl(FunctionName::kParabolicPot, 0.25);  // curvature 4 1/m
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 1.0, .thrust_max = 0.0};
  const auto run = tests::run<Forces<false, true, false>>(bowl, p, moving({}, {136.0, 0.0}), 20, 1);
  CHECK(run.louse.phase == state::Phase::kMoving);
  CHECK(run.counters.stops == 0);
}

TEST_CASE("friction and drag never add energy, on any function, at any rate") {
  core::Random random(8);
  for (const FunctionName name : terrain::kFunctionNames) {
    const FunctionSurface f(name, 20.0);
    for (const double rate : {20.0, 60.0, 240.0}) {
      const state::Parameters p{.gravity = 9.81, .drag = 0.2, .friction = 0.05};
      const state::Louse start = moving({30 * random.uniform() - 15, 30 * random.uniform() - 15},
                                        {8 * random.uniform() - 4, 8 * random.uniform() - 4});
      double last = tests::energy(f, start, 9.81);
      double worst = 0.0;
      tests::run<Forces<true, true, false>>(f, p, start, rate, std::lround(60 * rate), f.domain(),
                                            [&](const state::Louse& l) {
                                              const double now = tests::energy(f, l, 9.81);
                                              worst = std::fmax(worst, now - last);
                                              last = now;
                                              return true;
                                            });
      INFO(terrain::to_text(name) << " at " << rate << " Hz");
      CHECK(worst < 1e-6);
    }
  }
}

TEST_CASE("a brake holds on a slope where there is no friction, and never reverses the motion") {
  tests::Plane plane;
  plane.slope_x = 0.3;
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.0, .thrust_max = 4.0};
  state::Louse louse = moving({}, {1.0, 0.7});
  louse.thrust_kind = state::ThrustKind::kAlongHeading;
  louse.thrust = {-1.0, 0.0};
  const auto run = tests::run<Forces<false, false, true>>(plane, p, louse, 60, 6000);
  CHECK(run.louse.phase == state::Phase::kResting);
  CHECK(run.louse.velocity == core::Vec2{});
}

TEST_CASE("a pulse along the heading starts a louse from rest along its heading") {
  tests::Plane plane;
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.05, .thrust_max = 4.0};
  state::Louse louse = moving({}, {});
  louse.heading = {0.6, 0.8};
  louse.thrust_kind = state::ThrustKind::kAlongHeading;
  louse.thrust = {1.0, 0.0};
  const auto run = tests::run<Forces<false, true, true>>(plane, p, louse, 60, 60);
  const double a = 4.0 - 0.05 * 9.81;
  CHECK(run.louse.position.x == Approx(0.6 * 0.5 * a).epsilon(1e-12));
  CHECK(run.louse.position.y == Approx(0.8 * 0.5 * a).epsilon(1e-12));
}

TEST_CASE("a thrust above the threshold wakes a resting louse, its end lets it stop again") {
  const auto terrain = std::make_shared<const Terrain>(FunctionSurface(FunctionName::kParabolicPot, 20.0));
  World world(terrain, {}, 1.0 / 60);
  state::Louse louse;
  louse.id = 3;
  world.insert(louse);
  CHECK(world.find(3)->phase == state::Phase::kResting);
  world.set_thrust(3, {state::ThrustKind::kMapVector, {0.1, 0.0}}, state::kHeld);  // 0.4 < mu g
  world.step();
  CHECK(world.find(3)->phase == state::Phase::kResting);
  CHECK(world.counters().louse_steps == 0);
  world.set_thrust(3, {state::ThrustKind::kMapVector, {0.5, 0.0}}, 30);
  for (int i = 0; i < 30; ++i) world.step();
  CHECK(world.find(3)->phase == state::Phase::kMoving);
  CHECK(world.find(3)->thrust_kind == state::ThrustKind::kNone);
  for (int i = 0; i < 6000; ++i) world.step();
  CHECK(world.find(3)->phase == state::Phase::kResting);
  CHECK(world.find(3)->velocity == core::Vec2{});
}

TEST_CASE("a held thrust that keeps a louse on a slope lets it go when it ends") {
  const auto terrain = std::make_shared<const Terrain>(FunctionSurface(FunctionName::kParabolicPot, 20.0));
  World world(terrain, {}, 1.0 / 60);
  state::Louse louse;
  louse.id = 1;
  louse.position = {4.0, 0.0};  // slope 0.2
  louse.thrust = {0.5, 0.0};
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.thrust_ticks = 10;
  world.insert(louse);
  CHECK(world.find(1)->phase == state::Phase::kResting);
  for (int i = 0; i < 10; ++i) world.step();
  CHECK(world.find(1)->position == core::Vec2{4.0, 0.0});
  CHECK(world.find(1)->phase == state::Phase::kMoving);
  for (int i = 0; i < 10; ++i) world.step();
  CHECK(world.find(1)->position.x < 4.0);
}
