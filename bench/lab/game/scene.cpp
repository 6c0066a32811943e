#include "bench/lab/game/scene.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <variant>

#include "bench/lab/methods/steps.h"
#include "bench/lab/problems/motion.h"
#include "shared/core/random.h"
#include "shared/map/map_world.h"

namespace woodlouse::lab {
namespace {

constexpr double kPart = 0.4;  ///< of what changes with no tick [s]

std::uint64_t ticks_of_part(Play play, int rate) {
  return is_of_ticks(play) ? 1 : static_cast<std::uint64_t>(std::lround(kPart * rate));
}

}  // namespace

map::Map with_tolerance(const map::Map& map, double tolerance) {
  assert(tolerance >= 0.0);
  map::Map result = map;
  result.definition.physics.tolerance = tolerance;
  return result;
}

std::string_view to_text(Play play) {
  constexpr std::array<std::string_view, kPlays.size()> kNames = {"held vector",      "held heading",
                                                                  "pulsed vector",    "pulsed heading",
                                                                  "vector each tick", "heading each tick"};
  return kNames[static_cast<std::size_t>(play)];
}

state::Thrust thrust_in(Play play, std::uint64_t seed, std::uint64_t part) {
  const bool is_held = play == Play::kHeldVector || play == Play::kHeldHeading;
  core::Random random(seed * 1000003 + (is_held ? 0 : part));
  const double angle = 2.0 * std::numbers::pi * random.uniform();
  const auto vector = [&] { return state::rounded_map_vector({std::cos(angle), std::sin(angle)}).thrust; };
  const auto along = [](double value) { return state::rounded_along_heading(value).thrust; };
  switch (play) {
    case Play::kHeldVector:
    case Play::kVectorEachTick:
      return vector();
    case Play::kHeldHeading:
      return along(1.0);
    case Play::kPulsedVector:
      return part % 2 == 0 ? vector() : state::Thrust{};
    case Play::kPulsedHeading:
      return part % 2 == 0 ? along(1.0) : part % 4 == 1 ? along(-1.0) : state::Thrust{};
    default:
      return along(2.0 * random.uniform() - 1.0);
  }
}

std::vector<state::Louse> starting_lice(const map::Map& map, std::size_t count, std::uint64_t seed) {
  core::Random random(seed);
  const terrain::Rectangle domain = map.terrain->domain();
  const auto symmetric = [&] { return 2.0 * random.uniform() - 1.0; };
  const auto between = [&](double low, double high) {
    return 0.5 * (low + high) + 0.4 * (high - low) * symmetric();
  };
  std::vector<state::Louse> lice;
  for (std::uint32_t id = 1; id <= count; ++id) {
    const core::Vec2 place{between(domain.x_min, domain.x_max), between(domain.y_min, domain.y_max)};
    const double speed = id % 4 == 0 ? 0.0 : 3.0;  // a quarter of them stands
    const core::Vec2 velocity{speed * symmetric(), speed * symmetric()};
    lice.push_back(louse_at(place, velocity));
    state::Louse& louse = lice.back();
    louse.id = id;
    const double angle = std::numbers::pi * symmetric();
    louse.heading = speed > 0.0 ? (1.0 / std::hypot(velocity.x, velocity.y)) * velocity
                                : core::Vec2{std::cos(angle), std::sin(angle)};
  }
  return lice;
}

bool is_measured(const map::Map& map) {
  return map.definition.physics.equations == state::Equations::kExact &&
         reference::Ground::knows(*map.terrain);
}

std::unique_ptr<physics::World> world_of(const map::Map& map, Integrator integrator, int rate) {
  state::Parameters parameters = map::physics_of(map.definition, state::Mode::kRoam);
  const double tick = 1.0 / rate;
  if (const auto method = room_method(integrator)) {
    parameters.method = *method;
    return std::make_unique<physics::World>(map.terrain, parameters, tick);
  }
  const auto* spline = std::get_if<terrain::BicubicSpline>(&map.terrain->surface());
  if (spline == nullptr) return nullptr;
  const terrain::Rectangle walls = map.terrain->domain();
  return std::make_unique<physics::World>(map.terrain, parameters, tick, walls,
                                          exact_steps(*spline, integrator, {parameters, walls, tick}));
}

void steer(physics::World& world, Play play, int rate, std::uint64_t tick) {
  const std::uint64_t part = ticks_of_part(play, rate);
  if (tick % part != 0) return;
  for (std::size_t i = 0; i < world.lice().size(); ++i) {
    const state::LouseId id = world.lice()[i].id;
    world.set_thrust(id, thrust_in(play, id, tick / part), state::kHeld);
  }
}

void play_on(physics::World& world, Play play, int rate, std::uint64_t first_tick, std::uint64_t ticks) {
  for (std::uint64_t tick = first_tick; tick < first_tick + ticks; ++tick) {
    steer(world, play, rate, tick);
    world.step();
  }
}

reference::Motion true_way(const map::Map& map, const state::Louse& start, Play play, int rate,
                           double seconds, const reference::Care& care) {
  reference::Motion motion(*map.terrain, map::physics_of(map.definition, state::Mode::kRoam), start, care);
  const std::uint64_t ticks = ticks_of_part(play, rate);
  const auto whole = static_cast<std::uint64_t>(std::lround(seconds * rate));
  assert(whole % ticks == 0);
  const reference::Real part = static_cast<reference::Real>(ticks) * (1.0 / rate);
  for (std::uint64_t i = 0; i < whole / ticks; ++i) motion.advance(part, thrust_in(play, start.id, i));
  return motion;
}

double error_of(const map::Map& map, const state::Louse& louse, const reference::Motion& truth) {
  const auto place = truth.position();
  reference::Real x = louse.position.x - place.x;
  reference::Real y = louse.position.y - place.y;
  if (map.definition.physics.edges == state::Edges::kWrap) {
    const terrain::Rectangle domain = map.terrain->domain();
    x = std::remainder(x, static_cast<reference::Real>(domain.x_max) - domain.x_min);
    y = std::remainder(y, static_cast<reference::Real>(domain.y_max) - domain.y_min);
  }
  const double error = static_cast<double>(std::hypot(x, y));
  return std::isfinite(error) ? error : 1e300;
}

}  // namespace woodlouse::lab
