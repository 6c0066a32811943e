#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"
#include "shared/physics/ground_steps.h"
#include "shared/terrain/bicubic_spline.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::FunctionName;
using terrain::FunctionSurface;
using tests::moving;

TEST_CASE("an elastic impact keeps the energy, any other loses it, whatever the slope and direction") {
  core::Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const terrain::SlopeSample s{0, 4 * random.uniform() - 2, 4 * random.uniform() - 2};
    const Contact corner{random.uniform() < 0.5 ? -1 : 1, random.uniform() < 0.3 ? 1 : 0};
    const core::Vec2 v{2 * random.uniform() - 1, 2 * random.uniform() - 1};
    const double before = squared_length_in_space(s, v);
    for (const double e : {0.0, 0.5, 1.0}) {
      const core::Vec2 after = bounced(s, corner, v, e);
      CHECK_FALSE(outward(corner.x, after.x));
      CHECK_FALSE(outward(corner.y, after.y));
      CHECK(squared_length_in_space(s, after) <= before * (1 + 1e-14));
      if (e == 1.0 && corner.y == 0)
        CHECK(squared_length_in_space(s, after) == Approx(before).epsilon(1e-13));
    }
  }
}

TEST_CASE("leaning on walls never does work inwards and leaves no outward acceleration") {
  core::Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const terrain::SlopeSample s{0, 4 * random.uniform() - 2, 4 * random.uniform() - 2};
    const Contact corner{random.uniform() < 0.5 ? -1 : 1, random.uniform() < 0.5 ? 1 : -1};
    const core::Vec2 a{2 * random.uniform() - 1, 2 * random.uniform() - 1};
    const core::Vec2 left = supported(s, corner, a);
    CHECK_FALSE(outward(corner.x, left.x));
    CHECK_FALSE(outward(corner.y, left.y));
    // Gauss: of all that is allowed, the nearest in the surface's own length.
    CHECK(squared_length_in_space(s, left - a) <= squared_length_in_space(s, a) * (1 + 1e-12));
  }
}

TEST_CASE(
    "a louse never leaves the domain and never gains energy there: walls, corners, slopes, all "
    "restitutions") {
  core::Random random(3);
  const terrain::BicubicSpline hills(terrain::sample_function(FunctionName::kHills, 20.0, 10));
  const FunctionSurface wavy(FunctionName::kWavyPot, 20.0);
  const auto check = [&](const auto& surface) {
    for (int i = 0; i < 60; ++i) {
      const state::Parameters p{
          .gravity = 9.81, .drag = 0.0, .friction = 0.0, .edge_restitution = 0.5 * (i % 3)};
      const double angle = 6.28 * random.uniform();
      const state::Louse start = moving({38 * random.uniform() - 19, 38 * random.uniform() - 19},
                                        {15 * std::cos(angle), 15 * std::sin(angle)});
      double last = tests::energy(surface, start, 9.81);
      double worst = 0.0;
      bool inside = true;
      const auto end = tests::run<Forces<false, false, false>>(
          surface, p, start, 60, 1200, surface.domain(), [&](const state::Louse& l) {
            inside = inside && surface.domain().contains(l.position.x, l.position.y);
            const double now = tests::energy(surface, l, 9.81);
            worst = std::fmax(worst, now - last);
            last = now;
            return true;
          });
      INFO("run " << i);
      CHECK(inside);
      CHECK(worst < 2e-3);  // J/kg in a tick, of 100 and more: the step's own error at 15 m/s
      CHECK(end.counters.bounces > 0);
    }
  };
  check(hills);
  check(wavy);
}

TEST_CASE("on a plane, where the step has no error, energy never grows at walls and corners") {
  core::Random random(6);
  for (int i = 0; i < 400; ++i) {
    tests::Plane plane;
    plane.slope_x = 3 * random.uniform() - 1.5;
    plane.slope_y = 3 * random.uniform() - 1.5;
    const terrain::Rectangle walls{-1, -1, 1, 1};
    const state::Parameters p{
        .gravity = 9.81, .drag = 0.0, .friction = 0.0, .edge_restitution = random.uniform()};
    const state::Louse start = moving({1.8 * random.uniform() - 0.9, 1.8 * random.uniform() - 0.9},
                                      {6 * random.uniform() - 3, 6 * random.uniform() - 3});
    double last = tests::energy(plane, start, 9.81);
    double worst = 0.0;
    tests::run<Forces<false, false, false>>(plane, p, start, 60, 600, walls, [&](const state::Louse& l) {
      const double now = tests::energy(plane, l, 9.81);
      worst = std::fmax(worst, now - last);
      last = now;
      return walls.contains(l.position.x, l.position.y);
    });
    INFO("run " << i);
    CHECK(worst < 1e-10);
  }
}

TEST_CASE("pressed into a corner, a louse comes to rest and moves no more") {
  tests::Plane plane;
  plane.slope_x = -0.4;
  plane.slope_y = -0.3;
  const terrain::Rectangle walls{-1, -1, 1, 1};
  const state::Parameters p{.gravity = 9.81, .drag = 0.2, .friction = 0.05, .edge_restitution = 0.5};
  const auto run = tests::run<Forces<true, true, false>>(plane, p, moving({0, 0}, {}), 60, 6000, walls,
                                                         [](const state::Louse&) { return true; });
  CHECK(run.louse.phase == state::Phase::kResting);
  CHECK(run.louse.position == core::Vec2{1.0, 1.0});
}

TEST_CASE("a louse slides down along a wall as down an incline of the wall's slope") {
  tests::Plane plane;
  plane.slope_x = -1.0;
  plane.slope_y = -0.2;
  const terrain::Rectangle walls{-1, -100, 1, 100};
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.0, .edge_restitution = 0.0};
  const auto run = tests::run<Forces<false, false, false>>(plane, p, moving({1, 0}, {}), 60, 120, walls,
                                                           [](const state::Louse&) { return true; });
  CHECK(run.louse.position.x == 1.0);
  // In the vertical plane of the wall the slope is zy alone: a = g zy / (1 + zy^2).
  CHECK(run.louse.position.y == Approx(0.5 * 4.0 * 9.81 * 0.2 / 1.04).epsilon(1e-12));
}

TEST_CASE("a bouncing louse on the flat hits where the closed form says") {
  tests::Plane plane;
  const terrain::Rectangle walls{0, -1, 1, 1};
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.0, .edge_restitution = 0.5};
  const auto run = tests::run<Forces<false, false, false>>(plane, p, moving({0.5, 0}, {1, 0}), 60, 150, walls,
                                                           [](const state::Louse&) { return true; });
  // 0.5 s to the wall, 2 s back at half the speed: it is at the other wall at 2.5 s.
  CHECK(run.louse.position.x == Approx(0.0).margin(1e-12));
  CHECK(run.counters.bounces >= 1);
}

TEST_CASE("lice that push into walls and corners cost few sub-steps, and none stands there with a speed") {
  for (const FunctionName name : {FunctionName::kHills, FunctionName::kWaves}) {
    const terrain::BicubicSpline ground(terrain::sample_function(name, 20.0, 10));
    for (const state::Parameters& forces :
         {state::Parameters{.drag = 0.0, .friction = 0.0, .thrust_max = 6.0},
          state::Parameters{.drag = 0.2, .friction = 0.0, .thrust_max = 6.0},
          state::Parameters{.drag = 0.2, .friction = 0.05, .thrust_max = 6.0}}) {
      for (const double restitution : {0.0, 0.5, 1.0}) {
        state::Parameters p = forces;
        p.edge_restitution = restitution;
        const auto steps = make_ground_steps(ground, {p, ground.domain(), 1.0 / 60});
        core::Random random(12);
        const auto symmetric = [&](double size) { return size * (2 * random.uniform() - 1); };
        for (int i = 0; i < 24; ++i) {
          state::Louse louse = moving({symmetric(19.9), symmetric(19.9)}, {symmetric(4), symmetric(4)});
          louse.thrust_kind = state::ThrustKind::kMapVector;
          louse.thrust_ticks = state::kHeld;
          BatchLists lists;
          for (int tick = 0; tick < 1200 && louse.phase == state::Phase::kMoving; ++tick) {
            if (tick % 400 == 0)
              louse.thrust = core::Vec2{0.7 * std::cos(i + tick), 0.7 * std::sin(i + tick)};
            const state::Louse before = louse;
            StepCounters counters;
            const std::uint32_t index = 0;
            StepEvents happened = 0;
            steps->advance({&louse, 1}, {&index, 1}, {}, lists, counters, {&happened, 1});
            INFO(terrain::to_text(name)
                 << ", restitution " << restitution << ", louse " << i << ", tick " << tick);
            REQUIRE(counters.sub_steps < 600);
            REQUIRE((louse.position != before.position || dot(louse.velocity, louse.velocity) < 1e-6));
          }
        }
      }
    }
  }
}

TEST_CASE("along a wall a louse slides as far as the ground's share of its weight lets it") {
  // Pressed downhill against x = min of z = slope x, the wall carries a part: N = g w.
  for (const double slope : {1.0, 0.5}) {
    const tests::Plane ramp{{}, slope, 0.0};
    const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.3, .thrust_max = 0.0};
    const double right = 64.0 / (2.0 * 0.3 * 9.81 * std::sqrt(1.0 + slope * slope));
    for (const double rate : {15.0, 60.0, 1000.0}) {
      const auto run = tests::run<Forces<false, true, false>>(ramp, p, moving({0, 0}, {0, 8}), rate,
                                                              std::lround(10 * rate), {0, -50, 50, 50},
                                                              [](const state::Louse&) { return true; });
      CHECK(run.louse.phase == state::Phase::kResting);
      CHECK(run.louse.position.y == Approx(right).margin(1e-6));
    }
  }
}

TEST_CASE("what a wall carries follows from the statics of a ramp, a push uphill and a corner") {
  const terrain::SlopeSample s{0.0, 0.7, -0.4};
  const double w2 = 1.0 + 0.49 + 0.16;
  const core::Vec2 falling{-9.81 / w2 * 0.7, 9.81 / w2 * 0.4};
  CHECK(9.81 + wall_load(s, {-1, 0}, falling) == Approx(9.81 * w2 / (1.0 + 0.16)));
  // In a corner all is at rest: N / w = g.
  CHECK(9.81 + wall_load(s, {-1, 1}, falling) == Approx(9.81 * w2));
  // Pushed away from the wall, nothing is carried; uphill into the high wall, that holds a part of the
  // weight.
  CHECK(wall_load(s, {-1, 0}, falling + core::Vec2{9.0, 0.0}) == 0.0);
  CHECK(wall_load(s, {1, 0}, {3.0, 0.0}) == Approx(-0.7 * 3.0 * w2 / 1.16));
}

TEST_CASE("friction along the rim of a dome takes the power of the load that statics say") {
  const tests::Bowl dome{{}, -0.5};  // z = -r^2 / 2 presses outwards
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.2, .thrust_max = 0.0};
  constexpr double kRate = 4000.0;
  const state::Louse louse = moving({1, -0.5}, {0, 2});
  double energy = tests::energy(dome, louse, 9.81);
  int compared = 0;
  tests::run<Forces<false, true, false>>(
      dome, p, louse, kRate, 1600, {-2, -2, 1, 2}, [&](const state::Louse& l) {
        const double now = tests::energy(dome, l, 9.81);
        const double lost = (energy - now) * kRate;
        energy = now;
        const terrain::SurfaceSample at = dome.sample(l.position.x, l.position.y);
        const double w = std::sqrt(1.0 + at.zx * at.zx + at.zy * at.zy);
        const double load = w * (9.81 - l.velocity.y * l.velocity.y) / (1.0 + at.zy * at.zy);
        const double speed = std::sqrt(squared_length_in_space(at, l.velocity));
        if (l.position.x != 1.0 || l.position.y > 1.9 || speed < 0.5) return true;
        CHECK(lost == Approx(0.2 * std::fabs(load) * speed).epsilon(5e-3));
        ++compared;
        return true;
      });
  CHECK(compared > 500);
}

TEST_CASE("held against a wall by a push, a louse sticks where friction holds with what the ground carries") {
  // On level ground a wall changes no load; on a ramp pressed into x = min by gravity friction holds across
  // up to mu g w, by which a push along the wall must be larger.
  const tests::Plane ramp{{}, 1.0, 0.0};
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.3, .thrust_max = 10.0};
  const double holds = 0.3 * 9.81 * std::sqrt(2.0);
  for (const double push : {0.99, 1.01}) {
    state::Louse louse = moving({0, 0}, {});
    louse.thrust = {0.0, push * holds / 10.0};
    louse.thrust_kind = ThrustKind::kMapVector;
    louse.thrust_ticks = kHeld;
    const auto run = tests::run<Forces<false, true, true>>(ramp, p, louse, 60, 60, {0, -50, 50, 50},
                                                           [](const state::Louse&) { return true; });
    CHECK((run.louse.phase == state::Phase::kResting) == (push < 1.0));
    CHECK((run.louse.position.y > 0.0) == (push > 1.0));
  }
}

TEST_CASE(
    "pushed up a ramp and along its high wall, a louse takes off once the push's vertical part beats "
    "gravity") {
  // z = x at x = max: N w = 2 g - sqrt(2) f, of a push of f along the ramp; with its friction, which it
  // unloads.
  const tests::Plane ramp{{}, 1.0, 0.0};
  for (const double friction : {0.0, 0.3}) {
    for (const double push : {0.99, 1.01}) {
      state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = friction, .thrust_max = 20.0};
      p.contact = state::SurfaceContact::kUnilateral;
      state::Louse louse = moving({0, 0}, {0, 2});
      louse.thrust = {push * std::sqrt(2.0) * 9.81 / 20.0, 0.0};
      louse.thrust_kind = ThrustKind::kMapVector;
      louse.thrust_ticks = kHeld;
      const auto run = tests::run<Forces<true, true, true>>(ramp, p, louse, 60, 30, {-50, -50, 0, 50},
                                                            [](const state::Louse&) { return true; });
      INFO("push " << push << ", friction " << friction);
      CHECK((run.counters.flights > 0) == (push > 1.0));
    }
  }
}
