// Flat ground as a surface of its own: closed forms, and the same motion as on a spline through the same
// heights.
#include "shared/terrain/plane_surface.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::BicubicSpline;
using terrain::HeightGrid;
using terrain::PlaneSurface;
using terrain::Rectangle;
using terrain::Terrain;
using tests::moving;

namespace {

constexpr Rectangle kSquare{-20.0, -20.0, 20.0, 20.0};
constexpr double kTick = 1.0 / 60.0;

HeightGrid heights_of(const PlaneSurface& plane) {
  HeightGrid grid{11, 11, -20.0, -20.0, 4.0, 4.0, {}};
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      grid.heights.push_back(
          plane.sample(-20.0 + 4.0 * static_cast<double>(i), -20.0 + 4.0 * static_cast<double>(j)).z);
    }
  }
  return grid;
}

/// A plane's world without walls, and one louse in it.
World alone(core::Vec2 slope, const state::Parameters& parameters, const state::Louse& louse) {
  constexpr double kFar = 1e9;
  World world(std::make_shared<const Terrain>(PlaneSurface(kSquare, 1.0, slope)), parameters, kTick,
              {-kFar, -kFar, kFar, kFar});
  world.insert(louse);
  return world;
}

std::vector<state::Louse> crowd(double fastest) {
  core::Random random(8);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  std::vector<state::Louse> lice;
  for (state::LouseId id = 1; id <= 61; ++id) {
    lice.push_back(moving({symmetric(19), symmetric(19)}, {symmetric(fastest), symmetric(fastest)}, id));
    lice.back().thrust_kind = id % 3 == 0   ? state::ThrustKind::kNone
                              : id % 3 == 1 ? state::ThrustKind::kMapVector
                                            : state::ThrustKind::kAlongHeading;
    lice.back().thrust = {symmetric(0.7), symmetric(0.7)};
    lice.back().thrust_ticks = state::kHeld;
    if (id % 3 == 0) lice.back().thrust = {};
  }
  return lice;
}

}  // namespace

TEST_CASE("on an incline without friction a louse runs the parabola of constant acceleration, to rounding") {
  const core::Vec2 slope{0.3, -0.2};
  const state::Parameters bare{.gravity = 9.81, .drag = 0.0, .friction = 0.0, .thrust_max = 0.0};
  World world = alone(slope, bare, moving({1, 2}, {3, 1}));
  for (int tick = 0; tick < 6000; ++tick) world.step();
  const double t = 6000 * kTick;
  const core::Vec2 a = (-9.81 / (1.0 + dot(slope, slope))) * slope;
  const core::Vec2 place = core::Vec2{1, 2} + t * core::Vec2{3, 1} + (0.5 * t * t) * a;
  CHECK(world.lice()[0].position.x == Approx(place.x).epsilon(1e-12));
  CHECK(world.lice()[0].position.y == Approx(place.y).epsilon(1e-12));
  CHECK(world.counters().sub_steps == 6000);
}

TEST_CASE("on level ground drag alone brings a louse v / d far, friction alone v^2 / (2 mu g)") {
  World dragged =
      alone({}, {.gravity = 9.81, .drag = 0.5, .friction = 0.0, .thrust_max = 0.0}, moving({}, {3, 4}));
  for (int tick = 0; tick < 60 * 60; ++tick) dragged.step();
  CHECK(dragged.lice()[0].position.x == Approx(6.0).epsilon(1e-9));
  CHECK(dragged.lice()[0].position.y == Approx(8.0).epsilon(1e-9));

  World rubbed =
      alone({}, {.gravity = 9.81, .drag = 0.0, .friction = 0.2, .thrust_max = 0.0}, moving({}, {3, 4}));
  for (int tick = 0; tick < 60 * 60; ++tick) rubbed.step();
  const double way = 25.0 / (2 * 0.2 * 9.81);
  CHECK(rubbed.lice()[0].phase == state::Phase::kResting);
  CHECK(rubbed.lice()[0].position.x == Approx(0.6 * way).epsilon(1e-12));
  CHECK(rubbed.lice()[0].position.y == Approx(0.8 * way).epsilon(1e-12));
}

TEST_CASE(
    "on level ground of height 0 a slow louse has the bits it has on a spline, with every set and every "
    "force") {
  const PlaneSurface plane(kSquare, 0.0, {});
  const auto flat = std::make_shared<const Terrain>(plane);
  const auto spline = std::make_shared<const Terrain>(BicubicSpline(heights_of(plane)));
  for (unsigned forces = 1; forces < 8; ++forces) {  // 0: there the spline's world puts the energy right
    const state::Parameters p{.gravity = 9.81,
                              .drag = forces & 4u ? 0.2 : 0.0,
                              .friction = forces & 2u ? 0.15 : 0.0,
                              .thrust_max = forces & 1u ? 4.0 : 0.0};
    for (const InstructionSet set :
         {InstructionSet::kScalar, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
      if (!is_available(set)) continue;
      World ours(flat, p, kTick);
      World theirs(spline, p, kTick);
      ours.use(set);
      theirs.use(set);
      for (const state::Louse& louse : crowd(6.0)) {
        ours.insert(louse);
        theirs.insert(louse);
      }
      for (int tick = 0; tick < 600; ++tick) {
        ours.step();
        theirs.step();
      }
      INFO(to_text(set) << ", forces " << forces);
      CHECK(std::memcmp(ours.lice().data(), theirs.lice().data(), ours.lice().size_bytes()) == 0);
    }
  }
}

TEST_CASE("on an incline a crowd goes where it goes on a spline through the same heights") {
  const PlaneSurface plane(kSquare, 3.0, {0.1, 0.05});
  for (const state::Method method :
       {state::Method::kStandard, state::Method::kCheap, state::Method::kPrecise}) {
    state::Parameters p;
    p.method = method;
    World ours(std::make_shared<const Terrain>(plane), p, kTick);
    World theirs(std::make_shared<const Terrain>(BicubicSpline(heights_of(plane))), p, kTick);
    for (const state::Louse& louse : crowd(3.0)) {
      ours.insert(louse);
      theirs.insert(louse);
    }
    for (int tick = 0; tick < 60; ++tick) {
      ours.step();
      theirs.step();
    }
    // Not to rounding: a slope an ulp off can halve a sub-step that stays whole on the other ground, and each
    // may then lead as far astray as it may at all (sub_step_rules.h).
    for (std::size_t i = 0; i < ours.lice().size(); ++i) {
      CHECK(std::abs(ours.lice()[i].position.x - theirs.lice()[i].position.x) < 3e-7);
      CHECK(std::abs(ours.lice()[i].position.y - theirs.lice()[i].position.y) < 3e-7);
    }
  }
}

TEST_CASE("elastic walls around an incline neither give nor take energy") {
  const core::Vec2 slope{0.3, -0.2};
  const PlaneSurface plane(kSquare, 0.0, slope);
  const state::Parameters elastic{
      .gravity = 9.81, .drag = 0.0, .friction = 0.0, .thrust_max = 0.0, .edge_restitution = 1.0};
  World world(std::make_shared<const Terrain>(plane), elastic, kTick);
  world.insert(moving({1, 2}, {3, 1}));
  const auto energy_of = [&](const state::Louse& louse) {
    const double climb = dot(slope, louse.velocity);
    return 0.5 * (dot(louse.velocity, louse.velocity) + climb * climb) +
           9.81 * plane.sample(louse.position.x, louse.position.y).z;
  };
  const double before = energy_of(world.lice()[0]);
  for (int tick = 0; tick < 60 * 100; ++tick) world.step();
  CHECK(world.counters().bounces > 20);
  CHECK(energy_of(world.lice()[0]) == Approx(before).epsilon(1e-9));
}
