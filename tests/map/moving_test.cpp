// How lice move on shipped maps, at any rate: what a player or a bot may count on.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/map/map_world.h"
#include "shared/physics/central_gravity.h"

namespace woodlouse::map {
namespace {

std::shared_ptr<const Map> shipped(const std::string& name) {
  const auto map = load_map(WOODLOUSE_SOURCE_DIR "/maps/" + name + ".json");
  REQUIRE(map);
  return *map;
}

/// A place well inside the map.
core::Vec2 somewhere(const Map& map, core::Random& random) {
  const terrain::Rectangle d = map.terrain->domain();
  const double x = d.x_min + (0.15 + 0.7 * random.uniform()) * (d.x_max - d.x_min);
  return {x, d.y_min + (0.15 + 0.7 * random.uniform()) * (d.y_max - d.y_min)};
}

core::Vec2 direction(core::Random& random) {
  const double angle = 6.28 * random.uniform();
  return {std::cos(angle), std::sin(angle)};
}

/// Sixty lice at rest anywhere on the hills, looking anywhere, all drive along their headings for two
/// seconds.
std::vector<state::Louse> driven(const Map& map, int rate) {
  physics::World world = make_world(map, 1.0 / rate);
  core::Random random(7);
  for (state::LouseId id = 1; id <= 60; ++id) {
    state::Louse louse;
    louse.id = id;
    louse.position = somewhere(map, random);
    louse.heading = direction(random);
    world.insert(louse);
    world.set_thrust(id, {state::ThrustKind::kAlongHeading, {1.0, 0.0}}, state::kHeld);
  }
  for (int tick = 0; tick < 2 * rate; ++tick) world.step();
  return {world.lice().begin(), world.lice().end()};
}

struct Errors {
  double median, worst;
};

Errors between(const std::vector<state::Louse>& a, const std::vector<state::Louse>& b) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < a.size(); ++i)
    errors.push_back(std::hypot(a[i].position.x - b[i].position.x, a[i].position.y - b[i].position.y));
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors.back()};
}

/// Sub-steps a louse-step while each of forty lice gets a new thrust every `ticks` ticks, and where they end;
/// `fine` steps a tick.
struct Pushed {
  double sub_steps;
  std::vector<state::Louse> lice;
};

Pushed pushed(const Map& map, int ticks, int fine) {
  physics::World world = make_world(map, 1.0 / (60 * fine));
  core::Random places(3), thrusts(9);
  for (state::LouseId id = 1; id <= 40; ++id) {
    state::Louse louse;
    louse.id = id;
    louse.position = 0.5 * somewhere(map, places);
    world.insert(louse);
  }
  for (int tick = 0; tick < 300; ++tick) {
    for (state::LouseId id = 1; tick % ticks == 0 && id <= 40; ++id) {
      const core::Vec2 thrust = 0.99 * thrusts.uniform() * direction(thrusts);
      world.set_thrust(id, {state::ThrustKind::kMapVector, thrust}, state::kHeld);
    }
    for (int i = 0; i < fine; ++i) world.step();
  }
  const physics::StepCounters& c = world.counters();
  return {static_cast<double>(c.sub_steps) / static_cast<double>(c.louse_steps),
          {world.lice().begin(), world.lice().end()}};
}

/// Kinetic energy and the planet's pull.
double energy_at_planet(const physics::World& world) {
  const state::Louse& louse = world.lice()[0];
  return 0.5 * core::dot(louse.velocity, louse.velocity) +
         physics::central_potential(louse.position, world.parameters());
}

/// A louse from (10, 0) on the planet, across.
physics::World at_planet(const Map& map, double speed, int rate) {
  physics::World world = make_world(map, 1.0 / rate);
  state::Louse louse;
  louse.id = 1;
  louse.position = {10.0, 0.0};
  louse.velocity = {0.0, speed};
  world.insert(louse);
  return world;
}

}  // namespace

TEST_CASE("a drive along the heading leads to the same place at any rate, from rest across every slope") {
  const std::shared_ptr<const Map> map = shipped("hills");
  const std::vector<state::Louse> right = driven(*map, 1000);
  CHECK(between(driven(*map, 15), right).worst < 1e-3);
  CHECK(between(driven(*map, 60), right).worst < 1e-4);
  CHECK(between(driven(*map, 60), right).median < 2e-6);
  CHECK(between(driven(*map, 120), right).median < 0.5 * between(driven(*map, 60), right).median);
}

TEST_CASE("the distance travelled hardly depends on the rate") {
  const std::shared_ptr<const Map> map = shipped("hills");
  const auto travelled = [&](int rate) {
    physics::World world = make_world(*map, 1.0 / rate);
    state::Louse louse;
    louse.id = 1;
    louse.position = {1.3, 0.7};
    world.insert(louse);
    world.set_thrust(1, {state::ThrustKind::kMapVector, {0.6, 0.3}}, state::kHeld);
    for (int tick = 0; tick < 10 * rate; ++tick) world.step();
    return world.lice()[0].distance;
  };
  const double right = travelled(4000);
  const double coarse = std::fabs(travelled(15) - right);
  const double usual = std::fabs(travelled(60) - right);
  CHECK(usual < 1e-3);
  CHECK(usual < coarse / 12.0);  // order 2: 16
  CHECK(std::fabs(travelled(240) - right) < usual / 12.0);
}

TEST_CASE(
    "a thrust that changes with every tick costs twice as many sub-steps as a held one, and errs little") {
  const std::shared_ptr<const Map> map = shipped("volcano");
  const Pushed changing = pushed(*map, 1, 1);
  CHECK(changing.sub_steps < 2.0 * pushed(*map, 64, 1).sub_steps);
  CHECK(between(changing.lice, pushed(*map, 1, 16).lice).median < 1e-5);
}

TEST_CASE("a brake held on the planet takes energy in every tick, and the louse spirals in") {
  const std::shared_ptr<const Map> map = shipped("kepler");
  for (const int rate : {15, 60, 240, 1000}) {
    INFO(rate << " Hz");
    physics::World world = at_planet(*map, std::sqrt(10.0), rate);
    world.set_thrust(1, {state::ThrustKind::kAlongHeading, {-1.0, 0.0}}, state::kHeld);
    double before = energy_at_planet(world);
    REQUIRE(before == Approx(-5.0));
    double rise = -1e9;
    for (int tick = 0; tick < 40 * rate; ++tick) {
      world.step();
      rise = std::fmax(rise, energy_at_planet(world) - before);
      before = energy_at_planet(world);
    }
    const core::Vec2 place = world.lice()[0].position;
    CHECK(rise < 0.0);
    CHECK(before == Approx(-139.67).margin(0.01));
    CHECK(std::hypot(place.x, place.y) < 1.0);
  }
}

TEST_CASE("all but fallen into the middle, a louse comes out again, keeps its energy and costs little") {
  const std::shared_ptr<const Map> map = shipped("kepler");
  for (const int rate : {15, 60, 240, 1000}) {
    INFO(rate << " Hz");
    physics::World world = at_planet(*map, 0.1, rate);
    const double energy = energy_at_planet(world);
    double worst = 0.0, farthest = 0.0;
    std::uint64_t most = 0;
    for (int tick = 0; tick < 120 * rate; ++tick) {
      const std::uint64_t before = world.counters().sub_steps;
      world.step();
      most = std::max(most, world.counters().sub_steps - before);
      worst = std::fmax(worst, std::fabs(energy_at_planet(world) - energy));
      const core::Vec2 place = world.lice()[0].position;
      if (tick > 90 * rate) farthest = std::fmax(farthest, std::hypot(place.x, place.y));
    }
    const physics::StepCounters& counters = world.counters();
    CHECK(worst < 1e-5);
    CHECK(farthest == Approx(10.0).margin(1e-3));
    CHECK(most < 128);
    CHECK(counters.sub_steps < 4 * counters.louse_steps);
    CHECK(counters.capped == 0);
  }
}

}  // namespace woodlouse::map
