// What a step says happened to a louse.
#include "shared/state/step_events.h"

#include <catch2/catch.hpp>
#include <memory>

#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using tests::moving;

namespace {

constexpr terrain::Rectangle kArena{-20, -20, 20, 20};

World world_on(terrain::Terrain ground, const state::Parameters& parameters) {
  return {std::make_shared<const terrain::Terrain>(std::move(ground)), parameters, 1.0 / 60};
}

World world_of(terrain::FunctionName name, const state::Parameters& parameters) {
  return world_on(terrain::Terrain(terrain::BicubicSpline(terrain::sample_function(name, 20.0, 10))),
                  parameters);
}

/// The events of every louse's next step together.
StepEvents all_events(World& world) {
  world.step();
  StepEvents all = 0;
  for (const StepEvents happened : world.events()) all |= happened;
  return all;
}

}  // namespace

TEST_CASE("each louse's step tells of its wall, its stop and of nothing, and forgets it in the next") {
  World world = world_on(terrain::Terrain(terrain::PlaneSurface(kArena, 0.0, {})), {.friction = 0.5});
  world.insert(moving({19.99, 0}, {10, 0}, 1));
  world.insert(moving({0, 0}, {0.01, 0}, 2));
  world.insert(moving({5, 5}, {8, 0}, 4));
  world.step();
  REQUIRE(world.events().size() == 3);
  CHECK(world.events()[0] == kMetWall);
  CHECK(world.events()[1] == kStopped);
  CHECK(world.events()[2] == 0);
  world.insert(moving({0, 5}, {}, 3));
  CHECK(world.events()[2] == 0);
  CHECK(world.erase(1));
  REQUIRE(world.events().size() == world.lice().size());
  CHECK(world.events()[0] == kStopped);
  CHECK(all_events(world) == 0);
}

TEST_CASE("nobody moves and nothing happens any more") {
  World world = world_on(terrain::Terrain(terrain::PlaneSurface(kArena, 0.0, {})), {.friction = 0.5});
  world.insert(moving({0, 0}, {0.01, 0}, 1));
  CHECK(all_events(world) == kStopped);
  CHECK(all_events(world) == 0);
}

TEST_CASE("a seam is told of on the ground and in the air") {
  state::Parameters p{.gravity = 2.0};
  p.edges = state::Edges::kWrap;
  World ground = world_of(terrain::FunctionName::kWaves, p);
  ground.insert(moving({19.99, 0}, {10, 0}, 1));
  CHECK(all_events(ground) == kCrossedSeam);
  p.contact = state::SurfaceContact::kUnilateral;
  World air = world_of(terrain::FunctionName::kWaves, p);
  state::Louse louse = moving({19.99, 0}, {10, 0}, 1);
  louse.phase = state::Phase::kFlying;
  louse.flight_z = 100.0;
  air.restore({&louse, 1});
  CHECK(all_events(air) == kCrossedSeam);
}

TEST_CASE("take-offs, landings, walls and stops are those that are counted") {
  state::Parameters p{.gravity = 2.0, .drag = 0.1, .friction = 0.1, .thrust_max = 6.0};
  p.contact = state::SurfaceContact::kUnilateral;
  for (const InstructionSet set : {InstructionSet::kScalar, best_instruction_set()}) {
    World world = world_of(terrain::FunctionName::kHills, p);
    world.use(set);
    core::Random random(5);
    const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
    for (state::LouseId id = 1; id <= 60; ++id)
      world.insert(moving({symmetric(20), symmetric(20)}, {symmetric(12), symmetric(12)}, id));
    StepEvents seen = 0;
    for (int tick = 0; tick < 600; ++tick) {
      std::vector<state::Louse> before(world.lice().begin(), world.lice().end());
      const StepCounters counted = world.counters();
      world.step();
      std::size_t walls = 0, flights = 0;
      for (std::size_t i = 0; i < before.size(); ++i) {
        const StepEvents happened = world.events()[i];
        seen |= happened;
        walls += (happened & kMetWall) != 0;
        flights += (happened & kTookOff) != 0;
        const bool flew = before[i].phase == state::Phase::kFlying;
        const bool flies = world.lice()[i].phase == state::Phase::kFlying;
        if (flew && !flies) CHECK((happened & kLanded) != 0);
        if (!flew && flies) CHECK((happened & kTookOff) != 0);
        const bool rested = before[i].phase == state::Phase::kResting;
        CHECK(((happened & kStopped) != 0) == (!rested && world.lice()[i].phase == state::Phase::kResting));
      }
      CHECK((walls > 0) == (world.counters().bounces > counted.bounces));
      CHECK((flights > 0) == (world.counters().flights > counted.flights));
    }
    CHECK(seen == (kMetWall | kTookOff | kLanded | kStopped));
  }
}
