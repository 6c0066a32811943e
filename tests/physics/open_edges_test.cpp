// Edges that are open: a motion ends there.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using tests::moving;

namespace {

constexpr terrain::Rectangle kOpenArena{-20, -20, 20, 20};

World open_world_on(terrain::Terrain ground, const state::Parameters& parameters, double rate = 60) {
  return {std::make_shared<const terrain::Terrain>(std::move(ground)), parameters, 1.0 / rate};
}

World on_plane(core::Vec2 slope, const state::Parameters& parameters) {
  return open_world_on(terrain::Terrain(terrain::PlaneSurface(kOpenArena, 0.0, slope)), parameters);
}

World on_spline(terrain::FunctionName name, const state::Parameters& parameters, double rate = 60) {
  return open_world_on(terrain::Terrain(terrain::BicubicSpline(terrain::sample_function(name, 20.0, 10))),
                       parameters, rate);
}

state::Parameters open_edges() {
  state::Parameters p;
  p.edges = Edges::kOpen;
  return p;
}

bool is_at_rim(core::Vec2 p) { return std::abs(p.x) == 20.0 || std::abs(p.y) == 20.0; }

}  // namespace

TEST_CASE("who reaches an open edge stands there at once, looking where it went") {
  World world = on_plane({}, open_edges());
  world.insert(moving({19.99, 3}, {10, 5}, 1));
  world.insert(moving({-19.99, -19.99}, {-10, -10}, 2));
  world.insert(moving({0, 0}, {10, 0}, 3));
  world.step();
  CHECK(world.events()[0] == kLeft);
  CHECK(world.events()[1] == kLeft);
  CHECK(world.events()[2] == 0);
  const state::Louse& louse = world.lice()[0];
  CHECK(louse.position.x == 20.0);
  CHECK(louse.position.y == Approx(3.005).epsilon(1e-3));
  CHECK(louse.velocity == core::Vec2{});
  CHECK(louse.heading.x == Approx(10 / std::sqrt(125.0)).epsilon(1e-6));
  CHECK(louse.distance == Approx(0.01 * std::sqrt(1.25)).epsilon(1e-3));
  CHECK(world.lice()[1].position == core::Vec2{-20, -20});
  world.step();
  CHECK(world.events()[0] == kStopped);  // and friction keeps it
  world.step();
  CHECK(world.stands_still() == false);  // the third rolls
  CHECK(world.events()[0] == 0);
  CHECK(world.counters().bounces == 0);
}

TEST_CASE("who is pushed over an open edge stays, and is told of in each tick, until it is drawn inwards") {
  World world = on_plane({}, open_edges());
  world.insert(moving({20, 0}, {}, 1));
  world.set_thrust(1, {ThrustKind::kMapVector, {1, 0}}, kHeld);
  for (int i = 0; i < 50; ++i) {
    world.step();
    REQUIRE(world.events()[0] == kLeft);
    REQUIRE(world.lice()[0].position == core::Vec2{20, 0});
    REQUIRE(world.lice()[0].velocity == core::Vec2{});
  }
  world.set_thrust(1, {ThrustKind::kMapVector, {-1, 0}}, kHeld);
  for (int i = 0; i < 60; ++i) {
    world.step();
    REQUIRE(world.events()[0] == 0);
  }
  CHECK(world.lice()[0].position.x < 19);
  // A slope draws likewise.
  World slope = on_plane({0.2, 0}, open_edges());
  slope.insert(moving({-20, 0}, {}, 1));
  slope.insert(moving({20, 0}, {}, 2));
  slope.step();
  CHECK(slope.events()[0] == kLeft);
  CHECK(slope.events()[1] == 0);
  CHECK(slope.lice()[1].velocity.x < 0);
}

TEST_CASE("an open edge ends a flight, and the louse falls from there") {
  state::Parameters p = open_edges();
  p.contact = SurfaceContact::kUnilateral;
  for (const InstructionSet set : {InstructionSet::kScalar, best_instruction_set()}) {
    World world = on_spline(terrain::FunctionName::kHills, p);
    world.use(set);
    state::Louse louse = moving({19.95, 2}, {10, 0}, 1);
    louse.phase = Phase::kFlying;
    louse.flight_z = 5.0;
    louse.flight_vz = 2.0;
    world.restore({&louse, 1});
    world.step();
    CHECK(world.events()[0] == kLeft);
    CHECK(world.lice()[0].position == core::Vec2{20, 2});
    CHECK(world.lice()[0].velocity == core::Vec2{});
    CHECK(world.lice()[0].flight_vz == 0.0);
    CHECK(world.lice()[0].flight_z == Approx(5.0).margin(0.02));
    CHECK(world.lice()[0].heading == core::Vec2{1, 0});
    int ticks = 0;
    while (world.lice()[0].phase == Phase::kFlying && ++ticks < 100) world.step();
    const double fell = 5.0 - world.terrain().sample(20, 2).z;
    CHECK(ticks == Approx(60 * std::sqrt(2 * fell / 9.81)).margin(1.5));
    CHECK((world.events()[0] & kLanded) != 0);
  }
}

TEST_CASE(
    "until somebody reaches them, open edges are walls bit for bit, whatever the method and the speed") {
  for (const Method method : {Method::kStandard, Method::kCheap, Method::kPrecise}) {
    for (const SurfaceContact contact : {SurfaceContact::kBilateral, SurfaceContact::kUnilateral}) {
      for (const double fastest : {8.0, 3000.0}) {
        state::Parameters p{.thrust_max = 6.0};
        p.method = method;
        p.contact = contact;
        World walls = on_spline(terrain::FunctionName::kVolcano, p, 20);
        p.edges = Edges::kOpen;
        World open = on_spline(terrain::FunctionName::kVolcano, p, 20);
        core::Random random(7);
        const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
        for (LouseId id = 1; id <= 60; ++id) {
          // One after the other: compilers draw a call's arguments in orders of their own.
          const core::Vec2 velocity{symmetric(fastest), symmetric(fastest)};
          const core::Vec2 position{symmetric(19), symmetric(19)};
          const state::Louse louse = moving(position, velocity, id);
          for (World* world : {&walls, &open}) {
            world->insert(louse);
            world->set_thrust(id, {ThrustKind::kMapVector, {std::sin(id), std::cos(id)}}, kHeld);
          }
        }
        std::size_t left = 0, same = 0;
        for (int tick = 0; tick < 200; ++tick) {
          walls.step();
          open.step();
          for (std::size_t i = open.lice().size(); i-- > 0;) {
            const state::Louse& louse = open.lice()[i];
            INFO(to_text(method) << ", louse " << louse.id << ", tick " << tick);
            REQUIRE(std::isfinite(louse.position.x + louse.position.y + louse.flight_z));
            REQUIRE(kOpenArena.contains(louse.position.x, louse.position.y));
            if ((open.events()[i] & kLeft) != 0) {
              REQUIRE(is_at_rim(louse.position));
              REQUIRE(louse.velocity == core::Vec2{});
              const LouseId id = louse.id;
              open.erase(id);
              walls.erase(id);
              ++left;
              continue;
            }
            REQUIRE((walls.events()[i] & kMetWall) == 0);
            same += louse == walls.lice()[i];
            REQUIRE(louse == walls.lice()[i]);
          }
        }
        CHECK(left > 5);
        CHECK(same > 0);
        CHECK(open.counters().bounces == 0);
      }
    }
  }
}
