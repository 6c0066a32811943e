#include "shared/match/step_error.h"

#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "shared/map/map_world.h"
#include "shared/match/twin.h"
#include "shared/terrain/terrain.h"

using namespace woodlouse;
using namespace woodlouse::match;

namespace {

std::shared_ptr<map::Map> bumpy(state::Edges edges = state::Edges::kWalls) {
  auto map = std::make_shared<map::Map>();
  map->definition.name = "bumpy";
  map->definition.physics.edges = edges;
  map->terrain = std::make_shared<const terrain::Terrain>(
      terrain::BicubicSpline(terrain::sample_function(terrain::FunctionName::kVolcano, 20.0, 10)));
  return map;
}

state::Louse louse_at(core::Vec2 place, core::Vec2 velocity, state::LouseId id = 1) {
  state::Louse louse;
  louse.id = id;
  louse.position = place;
  louse.velocity = velocity;
  return louse;
}

std::vector<state::Louse> copy(std::span<const state::Louse> lice) { return {lice.begin(), lice.end()}; }

/// Metres that a second of play errs, two seconds of two lice, one of them pushed.
double figure_at(int rate) {
  const auto map = bumpy();
  physics::World world = map::make_world(*map, 1.0 / rate);
  world.insert(louse_at({5, 1}, {1, 2}, 1));
  world.insert(louse_at({-4, 2}, {-1, 0}, 2));
  world.set_thrust(2, {state::ThrustKind::kMapVector, {0.5, 0.5}}, state::kHeld);
  StepError error(*map, 1.0 / rate, state::Mode::kRoam);
  for (int tick = 0; tick < 2 * rate; ++tick) {
    error.observe(world.lice(), static_cast<std::uint64_t>(tick));
    world.step();
  }
  CHECK(error.figures().size() == 2);
  CHECK(error.figures().at(1).ticks == static_cast<std::uint64_t>(2 * rate));
  return error.of_play(error.figures().at(1)) + error.of_play(error.figures().at(2));
}

}  // namespace

TEST_CASE(
    "who asks for a step's error steps as the room does, bit for bit, whatever thrust ends in the tick") {
  const auto map = bumpy();
  constexpr double kTick = 1.0 / 60;
  physics::World world = map::make_world(*map, kTick);
  for (state::LouseId id = 1; id <= 20; ++id)
    world.insert(louse_at({0.7 * id - 8.0, 0.3 * id - 2.0}, {0.1 * id, 1.5 - 0.2 * id}, id));
  StepError error(*map, kTick, state::Mode::kRoam);
  for (std::uint64_t tick = 0; tick < 200; ++tick) {
    for (state::LouseId id = 1; id <= 20; ++id) {
      if ((tick + id) % 9 == 0)
        world.set_thrust(id,
                         {id % 2 == 0 ? state::ThrustKind::kMapVector : state::ThrustKind::kAlongHeading,
                          {id % 3 == 0 ? -0.5 : 0.5, 0.0}},
                         1 + id % 4);
    }
    error.observe(world.lice(), tick);
    world.step();
    REQUIRE(error.bounds().size() == 20);
    for (std::size_t i = 0; i < 20; ++i) {
      REQUIRE(error.stepped()[i].position == world.lice()[i].position);
      REQUIRE(error.stepped()[i].velocity == world.lice()[i].velocity);
      REQUIRE(error.bounds()[i] >= 0.0);
      REQUIRE(error.bounds()[i] < 1e-3);
    }
  }
}

TEST_CASE("the error figure falls with the step, and who rests errs nothing") {
  const double at_15 = figure_at(15), at_60 = figure_at(60), at_240 = figure_at(240);
  CHECK(at_15 > 30.0 * at_60);
  CHECK(at_60 > 5.0 * at_240);  // knot lines cost the order
  CHECK(at_240 > 0.0);

  auto map = bumpy();
  map->definition.physics.friction = 5.0;
  physics::World world = map::make_world(*map, 1.0 / 60);
  world.insert(louse_at({3, 3}, {}));
  REQUIRE(world.lice()[0].phase == state::Phase::kResting);
  StepError error(*map, 1.0 / 60, state::Mode::kRoam);
  CHECK(error.of_play({}) == 0.0);
  for (std::uint64_t tick = 0; tick < 10; ++tick) error.observe(world.lice(), tick);
  CHECK(error.figures().at(1).ticks == 10);
  CHECK(error.figures().at(1).sum == 0.0);
  CHECK(error.of_play(error.figures().at(1)) == 0.0);
}

TEST_CASE("the worst tick is named, and a louse that left keeps its figure") {
  const auto map = bumpy();
  StepError error(*map, 1.0 / 60, state::Mode::kRoam);
  double worst = 0.0;
  std::uint64_t worst_tick = 0;
  for (std::uint64_t tick = 7; tick < 10; ++tick) {
    const state::Louse louse = louse_at({5, 1}, tick == 8 ? core::Vec2{6, 5} : core::Vec2{1, 1});
    error.observe({&louse, 1}, tick);
    if (error.bounds()[0] > worst) {
      worst = error.bounds()[0];
      worst_tick = tick;
    }
  }
  error.observe({}, 10);
  CHECK(error.bounds().empty());
  const ErrorFigure& figure = error.figures().at(1);
  CHECK(figure.worst == worst);
  CHECK(figure.worst_tick == worst_tick);
  CHECK(figure.ticks == 3);
  CHECK(figure.sum >= figure.worst);
  CHECK(error.of_play(figure) == Approx(figure.sum * 60 / 3));
}

TEST_CASE("over a seam places are as far apart as the shorter way round") {
  const terrain::Rectangle domain{-10, -10, 10, 10};
  CHECK(distance_over_map({9.5, 0}, {-9.5, 0}, domain, state::Edges::kWrap) == Approx(1.0));
  CHECK(distance_over_map({9.5, 0}, {-9.5, 0}, domain, state::Edges::kWalls) == Approx(19.0));
  CHECK(distance_apart(louse_at({1, 2}, {0, 3}), louse_at({1, 2}, {4, 0}), domain, state::Edges::kWalls) ==
        Approx(5.0 * kAhead));
}

TEST_CASE("a twin at half the step goes its own way for ten seconds, and begins anew with whom others move") {
  const auto map = bumpy();
  constexpr double kTick = 1.0 / 60;
  physics::World world = map::make_world(*map, kTick);
  world.insert(louse_at({5, 1}, {1, 2}, 1));
  world.insert(louse_at({-4, 2}, {-1, 0}, 2));
  Twin twin(*map, kTick, state::Mode::kRoam);
  for (int tick = 0; tick < 1250; ++tick) {
    if (tick % 50 == 0)
      world.set_thrust(1, {state::ThrustKind::kMapVector, {tick % 100 == 0 ? 0.5 : -0.5, 0.25}}, 20);
    if (tick == 100) world.set_motion(2, {3, 3}, {0.5, 0.5});
    const auto before = copy(world.lice());
    world.step();
    twin.observe(before, world.lice());
  }
  // The first louse had two windows; the second one began anew at tick 100 and has one of them to come.
  REQUIRE(twin.divergences().at(1).size() == 2);
  REQUIRE(twin.divergences().at(2).size() == 1);
  for (const double apart : twin.divergences().at(1)) {
    CHECK(apart > 0.0);
    CHECK(apart < 1e-2);
  }
}
