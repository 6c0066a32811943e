// That no louse makes energy, on grounds whose dents are smaller than its steps: by any method, contact and
// thrust. In a tick it may gain 1e-3 of what it has above the map's lowest place, with `cheap` 1e-2, and what
// a push can give.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "shared/terrain/terrain.h"
#include "tests/fuzz/physics_energy.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::FunctionName;
using terrain::FunctionSurface;
using terrain::Terrain;
using tests::moving;

namespace {

constexpr std::array kMethodsTold = {Method::kStandard, Method::kCheap, Method::kPrecise};

/// 7 knots a side; heights within half of `height` [m].
std::shared_ptr<const Terrain> dented(double spacing, double height, std::uint64_t seed,
                                      terrain::SplineEnds ends = terrain::SplineEnds::kNotAKnot) {
  core::Random random(seed);
  terrain::HeightGrid grid;
  grid.columns = grid.rows = 7;
  grid.dx = grid.dy = spacing;
  grid.x_origin = grid.y_origin = -3.0 * spacing;
  for (std::size_t k = 0; k < grid.columns * grid.rows; ++k)
    grid.heights.push_back(height * (random.uniform() - 0.5));
  if (ends == terrain::SplineEnds::kPeriodic) {
    for (std::size_t k = 0; k < 7; ++k) grid.heights[7 * k + 6] = grid.heights[7 * k];
    for (std::size_t k = 0; k < 7; ++k) grid.heights[42 + k] = grid.heights[k];
  }
  return std::make_shared<const Terrain>(terrain::BicubicSpline(grid, ends));
}

state::Louse anywhere(core::Random& random, const terrain::Rectangle& domain, double speed) {
  const double x = domain.x_min + random.uniform() * (domain.x_max - domain.x_min);
  const double y = domain.y_min + random.uniform() * (domain.y_max - domain.y_min);
  const double angle = 6.3 * random.uniform();
  state::Louse louse = moving({x, y}, {speed * std::cos(angle), speed * std::sin(angle)});
  louse.heading = {std::cos(angle), std::sin(angle)};
  return louse;
}

/// None, a map vector, along the heading, a brake; held.
void push(World& world, LouseId id, int kind) {
  if (kind == 1) world.set_thrust(id, {ThrustKind::kMapVector, {0.6, -0.8}}, kHeld);
  if (kind == 2) world.set_thrust(id, {ThrustKind::kAlongHeading, {1.0, 0.0}}, kHeld);
  if (kind == 3) world.set_thrust(id, {ThrustKind::kAlongHeading, {-0.5, 0.0}}, kHeld);
}

/// The most that one of 48 lice gains in one of 40 ticks, of what it has and may err by: above 1 it is too
/// much.
double worst_gain(const std::shared_ptr<const Terrain>& ground, const Parameters& p, double rate,
                  double speed, std::uint64_t seed) {
  World world(ground, p, 1.0 / rate);
  const fuzz::EnergyLaw law(*ground, p);
  core::Random random(seed);
  for (LouseId id = 1; id <= 48; ++id) {
    state::Louse louse = anywhere(random, ground->domain(), id % 3 == 0 ? 0.0 : speed * random.uniform());
    louse.id = id;
    world.insert(louse);
    push(world, id, static_cast<int>(id % 4));
  }
  double worst = 0.0;
  for (int tick = 0; tick < 40; ++tick) {
    const std::vector<state::Louse> before(world.lice().begin(), world.lice().end());
    world.step();
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double energy = law.of(world.lice()[k]);
      REQUIRE(std::isfinite(energy));
      worst = std::max(worst, law.gained_share(before[k], energy, 1.0 / rate) / law.error_share());
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("what a capped step may have of a push is its work, by where it acts") {
  const tests::Plane level;
  const state::Parameters p{9.81, 0.0, 0.0, 4.0, 1.0};
  using Ground = physics::Ground<tests::Plane, Forces<false, false, true>, SurfaceEquations>;
  const Ground ground(level, p);
  const Rim rim(tests::kNowhere, p.edges);
  constexpr double kStep = 1.0 / 60;
  const auto speed_after = [&](const state::Louse& louse, core::Vec2 end) {
    Drive drive = drive_of<true>(louse, p.thrust_max);
    bool bounces = false;
    const auto start = ground.depart<true>({louse.position, louse.velocity}, drive, rim, 1.0, bounces);
    const Motion bounded =
        energy_bounded<false>(level, rim, p, start, drive, kStep, {{0.02, 0.0}, end}, false, 0.0);
    return std::hypot(bounded.velocity.x, bounded.velocity.y);
  };
  state::Louse louse = moving({0, 0}, {1, 0});
  louse.thrust_kind = ThrustKind::kMapVector;
  louse.thrust = {-0.5, 0.0};
  CHECK(speed_after(louse, {1.5, 0.0}) == Approx(1.0 - 2.0 * kStep).epsilon(1e-14));
  louse.thrust = {0.5, 0.0};
  CHECK(speed_after(louse, {1.5, 0.0}) == Approx(1.0 + 2.0 * kStep).epsilon(1e-14));
  louse.thrust = {0.0, 1.0};
  CHECK(speed_after(louse, {1.5, 0.0}) == Approx(1.0).epsilon(1e-14));
  louse.thrust_kind = ThrustKind::kAlongHeading;
  louse.thrust = {1.0, 0.0};
  louse.heading = {-1.0, 0.0};
  CHECK(speed_after(louse, {1.5, 0.0}) == Approx(1.0 - 4.0 * kStep).epsilon(1e-14));
  louse.velocity = {};
  CHECK(speed_after(louse, {-1.5, 0.0}) == Approx(4.0 * kStep).epsilon(1e-14));
}

TEST_CASE("nobody makes energy among dents that a step leads over, by any method and contact") {
  for (const auto& [rate, steepness] : {std::pair{30.0, 8.0}, std::pair{10.0, 1.0}}) {
    for (const Method method : kMethodsTold) {
      for (const SurfaceContact contact : {SurfaceContact::kBilateral, SurfaceContact::kUnilateral}) {
        for (const double friction : {0.0, 0.3}) {
          Parameters p{.gravity = 9.81, .drag = 0.0, .friction = friction, .thrust_max = 4.0};
          p.edge_restitution = 0.9;
          p.method = method;
          p.contact = contact;
          INFO(to_text(method) << ", " << rate << " Hz, friction " << friction << ", " << to_text(contact));
          CHECK(worst_gain(dented(0.06, 0.06 * steepness, 3), p, rate, 30.0, 5) <= 1.0);
          CHECK(worst_gain(dented(0.06, 0.06 * steepness, 3), p, rate, 30.0, 6) <= 1.0);
        }
      }
    }
  }
}

TEST_CASE("however fast it goes over whatever dents, a louse's distance is that of a way it can have gone") {
  constexpr double kSpeed = 1000.0;
  for (const Method method : kMethodsTold) {
    Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.1, .thrust_max = 4.0};
    p.edge_restitution = 0.9;
    p.method = method;
    World world(dented(0.01, 0.03, 4), p, 1.0 / 15);
    core::Random random(2);
    for (LouseId id = 1; id <= 40; ++id) {
      state::Louse louse = anywhere(random, world.terrain().domain(), kSpeed * random.uniform());
      louse.id = id;
      world.insert(louse);
      push(world, id, static_cast<int>(id % 4));
    }
    for (int tick = 1; tick <= 60; ++tick) {
      world.step();
      // In space it is as fast as its slope lets it be: on dents like these up to twenty times as in the
      // plane.
      for (const state::Louse& louse : world.lice()) REQUIRE(louse.distance <= 20.0 * kSpeed * tick / 15);
    }
    CHECK(world.counters().capped > 0);
  }
}

TEST_CASE("nobody makes energy on a function that has no cells to shorten steps by") {
  const auto ground = std::make_shared<const Terrain>(FunctionSurface(FunctionName::kWaves, 0.1));
  for (const Method method : kMethodsTold) {
    for (const SurfaceContact contact : {SurfaceContact::kBilateral, SurfaceContact::kUnilateral}) {
      for (const double friction : {0.0, 0.25}) {
        Parameters p{.gravity = 9.81, .drag = 0.0, .friction = friction, .thrust_max = 2.0};
        p.edge_restitution = 1.0;
        p.method = method;
        p.contact = contact;
        INFO(to_text(method) << ", friction " << friction << ", " << to_text(contact));
        CHECK(worst_gain(ground, p, 30, 40.0, 8) <= 1.0);
      }
    }
  }
}

TEST_CASE("nobody makes energy over seams of maps that a step crosses whole, on the ground and in the air") {
  const auto ground = dented(0.06, 0.48, 11, terrain::SplineEnds::kPeriodic);
  for (const Method method : kMethodsTold) {
    for (const SurfaceContact contact : {SurfaceContact::kBilateral, SurfaceContact::kUnilateral}) {
      for (const double friction : {0.0, 0.3}) {
        Parameters p{.gravity = 9.81, .drag = 0.0, .friction = friction, .thrust_max = 4.0};
        p.edges = Edges::kWrap;
        p.edge_restitution = 0.9;
        p.method = method;
        p.contact = contact;
        INFO(to_text(method) << ", friction " << friction << ", " << to_text(contact));
        CHECK(worst_gain(ground, p, 2, 30.0, 6) <= 1.0);
      }
    }
  }
}

TEST_CASE("friction of what curvature alone loads makes no energy") {
  const auto ground = std::make_shared<const Terrain>(FunctionSurface(FunctionName::kWaves, 0.1));
  for (const Method method : kMethodsTold) {
    Parameters p{.gravity = 0.0, .drag = 0.0, .friction = 3.0, .thrust_max = 0.0};
    p.method = method;
    INFO(to_text(method));
    CHECK(worst_gain(ground, p, 15, 3.0, 20) <= 1.0);
  }
}

TEST_CASE("who halts does so where his energy leads, deep in the core of a pull too") {
  for (const double rate : {1.0, 5.0, 30.0}) {
    for (const Method method : kMethodsTold) {
      Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.4, .thrust_max = 20.0};
      p.central_gravity = 100.0;
      p.core_radius = 0.01;
      p.method = method;
      INFO(to_text(method) << " at " << rate << " Hz");
      CHECK(worst_gain(dented(0.5, 0.5, 23), p, rate, 3.0, 29) <= 1.0);
    }
  }
}
