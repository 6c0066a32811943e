#include "bench/lab/problems/events.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bench/lab/problems/motion.h"
#include "shared/physics/central_gravity.h"
#include "shared/physics/world.h"

namespace woodlouse::lab {
namespace {

using core::Random;
using core::Vec2;
using state::Louse;
using terrain::FunctionName;
using Ground = std::shared_ptr<const terrain::Terrain>;

constexpr double kHalf = 5.0;  // [m], of the grounds' sides
constexpr double kSlow = 0.5;  // [m/s]
constexpr double kPull = 100.0, kWideCore = 5.0;

Ground function(FunctionName name) {
  return std::make_shared<const terrain::Terrain>(terrain::FunctionSurface(name, kHalf));
}
/// grid: cells from the middle to the rim.
Ground spline(FunctionName name, std::size_t grid,
              terrain::SplineEnds ends = terrain::SplineEnds::kNotAKnot) {
  return std::make_shared<const terrain::Terrain>(
      terrain::BicubicSpline(terrain::sample_function(name, kHalf, grid), ends));
}
Ground level() {
  return std::make_shared<const terrain::Terrain>(
      *terrain::plane_through({5, 5, -20.0, -20.0, 10.0, 10.0, std::vector<double>(25, 0.0)}));
}

Vec2 direction(Random& random) {
  const double angle = 2.0 * std::numbers::pi * random.uniform();
  return {std::cos(angle), std::sin(angle)};
}
double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

/// Anywhere within `half` of the middle, any way.
std::function<Louse(Random&)> rolling(double half, double slowest, double fastest) {
  return [=](Random& random) {
    const double x = between(random, -half, half);
    const double y = between(random, -half, half);
    const Vec2 way = direction(random);
    return louse_at({x, y}, between(random, slowest, fastest) * way);
  };
}

/// Towards the rim at +x, from a metre or less before it.
Louse outward(Random& random) {
  const double x = kHalf - between(random, 0.3, 1.0);
  const double y = between(random, -2.0, 2.0);
  const double speed = between(random, 2.0, 4.0);
  return louse_at({x, y}, {speed, between(random, -1.0, 1.0)});
}

/// Standing, to drive off along its heading.
Louse at_rest(Random& random) {
  const double x = between(random, -3.0, 3.0);
  const double y = between(random, -3.0, 3.0);
  Louse louse = louse_at({x, y}, {});
  louse.heading = direction(random);
  louse.thrust_kind = state::ThrustKind::kAlongHeading;
  louse.thrust = {1.0, 0.0};
  louse.thrust_ticks = state::kHeld;
  return louse;
}

/// Fast enough to take off from a crest, but not where it starts.
std::function<Louse(Random&)> pressed(const Ground& ground) {
  return [ground](Random& random) {
    Louse louse;
    terrain::SurfaceSample s;
    do {
      louse = rolling(3.5, 4.0, 8.0)(random);
      s = ground->sample(louse.position.x, louse.position.y);
    } while (!(9.81 + physics::curvature_along(s, louse.velocity) > 3.0));
    return louse;
  };
}

/// Thrown into the air over that ground.
std::function<Louse(Random&)> thrown(const Ground& ground) {
  return [ground](Random& random) {
    Louse louse = rolling(2.5, 1.0, 4.0)(random);
    louse.phase = state::Phase::kFlying;
    louse.flight_z = ground->sample(louse.position.x, louse.position.y).z + between(random, 0.2, 1.0);
    louse.flight_vz = between(random, -1.0, 1.0);
    return louse;
  };
}

/// Past the planet's middle, from `far` away.
std::function<Louse(Random&)> passing(double far, double aside, double speed) {
  return [=](Random& random) {
    const Vec2 out = direction(random);
    const double b = between(random, -aside, aside);
    return louse_at({far * out.x - b * out.y, far * out.y + b * out.x}, -speed * out);
  };
}

/// Rolling with drag and friction, and thrusts to 4 m/s^2.
state::Parameters rough(double friction = 0.05) { return {9.81, 0.2, friction, 4.0, 0.5}; }
state::Parameters free_of_forces() { return {9.81, 0.0, 0.0, 0.0, 0.5}; }
state::Parameters in_air() {
  state::Parameters p = rough();
  p.contact = state::SurfaceContact::kUnilateral;
  return p;
}
state::Parameters endless() {
  state::Parameters p = rough();
  p.edges = state::Edges::kWrap;
  return p;
}
state::Parameters planet(double core_radius) {
  state::Parameters p{0.0, 0.0, 0.0, 0.5, 0.5};
  p.central_gravity = kPull;
  p.core_radius = core_radius;
  return p;
}

/// The same event on the function, within a cell of its spline (of four cells a side) and across lines of its
/// spline of twenty.
/// start: makes what starts on such a ground.
template <typename Start>
void on_each_ground(std::vector<Event>& all, const Event& event, FunctionName name, const Start& start,
                    const Met& wanted, terrain::SplineEnds ends = terrain::SplineEnds::kNotAKnot) {
  const auto add = [&](const char* ground, Ground terrain, bool crosses) {
    Event one = event;
    one.ground = ground;
    one.start = start(terrain);
    one.terrain = std::move(terrain);
    one.is_met = [wanted, crosses](Met met) {
      const bool crossed = std::exchange(met.lines, 0) > 0;
      return crossed == crosses && met == wanted;
    };
    all.push_back(std::move(one));
  };
  add("function", function(name), false);
  if (ends == terrain::SplineEnds::kNotAKnot) add("cell", spline(name, 2, ends), false);
  add("spline", spline(name, 10, ends), true);
}

void look(const Event& event, const Louse& before, const Louse& after, Met& met) {
  const auto* ground = std::get_if<terrain::BicubicSpline>(&event.terrain->surface());
  const auto has = [](const Louse& louse, state::Phase phase) { return louse.phase == phase ? 1 : 0; };
  if (ground != nullptr && after.phase != state::Phase::kFlying) {
    const auto from = ground->cell_at(before.position.x, before.position.y);
    const auto to = ground->cell_at(after.position.x, after.position.y);
    met.lines += from.column != to.column || from.row != to.row ? 1 : 0;
  }
  if (distance(before.position, after.position) > kHalf) ++met.seams;
  met.slow = met.slow ||
             (after.phase == state::Phase::kMoving && dot(after.velocity, after.velocity) < kSlow * kSlow);
  met.landings += has(before, state::Phase::kFlying) * (1 - has(after, state::Phase::kFlying));
  met.stops += has(after, state::Phase::kResting) * (1 - has(before, state::Phase::kResting));
  if (event.parameters.central_gravity > 0.0) {
    const double radius = event.parameters.core_radius;
    const bool was_in = dot(before.position, before.position) < radius * radius;
    if (was_in != (dot(after.position, after.position) < radius * radius)) ++met.core_rims;
  }
}

}  // namespace

std::vector<Event> events() {
  using Start = std::function<Louse(Random&)>;
  const auto rolls = [](const Ground&) { return rolling(3.5, 1.5, 4.0); };
  const auto slowly = [](const Ground&) { return rolling(3.5, 0.5, 2.5); };
  const auto to_the_rim = [](const Ground&) { return Start(outward); };
  const auto stands = [](const Ground&) { return Start(at_rest); };
  std::vector<Event> all;
  const auto on_hills = [&](const char* name, const state::Parameters& p, int fifteenths, const auto& start,
                            const Met& wanted, bool changes = false) {
    on_each_ground(all, {name, "", nullptr, p, fifteenths, nullptr, nullptr, changes}, FunctionName::kHills,
                   start, wanted);
  };
  on_hills("none", rough(), 12, rolls, {});
  on_hills("none, energy kept", free_of_forces(), 12, rolls, {});
  on_hills("a wall", rough(0.3), 9, to_the_rim, {.walls = 1});
  on_each_ground(all, {"a seam", "", nullptr, endless(), 9, nullptr, nullptr}, FunctionName::kWaves,
                 to_the_rim, {.seams = 1}, terrain::SplineEnds::kPeriodic);
  on_hills("a take-off", in_air(), 9, pressed, {.take_offs = 1});
  on_hills("a landing", in_air(), 12, thrown, {.landings = 1});
  on_hills("a stop", rough(0.6), 15, slowly, {.stops = 1, .slow = true});
  on_hills("hardly moving under friction", rough(0.2), 12, slowly, {.slow = true});
  on_hills("along the heading, from rest", rough(0.0), 15, stands, {.slow = true});
  on_hills("from rest under friction", rough(), 15, stands, {.slow = true});
  on_hills("a thrust that changes", rough(), 12, rolls, {}, true);
  const auto central = [&](const char* name, double core, int fifteenths,
                           std::function<Louse(Random&)> start) {
    all.push_back({name, "plane", level(), planet(core), fifteenths, std::move(start),
                   [](const Met& met) { return met == Met{.core_rims = 2}; }});
  };
  central("the rim of a core of 5 m", kWideCore, 15, passing(8.0, 3.0, 12.0));
  central("the rim of the default core", physics::default_core_radius(kPull), 3, passing(1.0, 0.15, 10.0));
  return all;
}

Arrival arrival(const Event& event, state::Method method, const Louse& start, std::uint64_t whims, int rate) {
  state::Parameters parameters = event.parameters;
  parameters.method = method;
  physics::World world(event.terrain, parameters, 1.0 / rate);
  world.insert(start);
  Random random(whims);
  Arrival result;
  const int ticks = rate / kThrustsPerSecond;
  for (int fifteenth = 0; fifteenth < event.fifteenths; ++fifteenth) {
    if (event.thrust_changes) {
      const double size = 0.99 * random.uniform();
      world.set_thrust(start.id, {state::ThrustKind::kMapVector, size * direction(random)}, state::kHeld);
    }
    for (int tick = 0; tick < ticks; ++tick) {
      const Louse before = world.lice()[0];
      world.step();
      look(event, before, world.lice()[0], result.met);
    }
  }
  const physics::StepCounters& counters = world.counters();
  result.met.walls = static_cast<int>(counters.bounces);
  result.met.take_offs = static_cast<int>(counters.flights);
  result.louse = world.lice()[0];
  result.sub_steps = static_cast<double>(counters.sub_steps) /
                     static_cast<double>(std::max<std::uint64_t>(1, counters.louse_steps));
  return result;
}

}  // namespace woodlouse::lab
