// Maps whose edges wrap: the seam must not be there for anything but the position's number.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "shared/core/random.h"
#include "shared/physics/rim.h"
#include "shared/physics/world.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::BicubicSpline;
using terrain::FunctionName;
using terrain::FunctionSurface;
using terrain::HeightGrid;
using terrain::SplineEnds;
using terrain::Terrain;

namespace {

constexpr double kHalf = 20.0;  // half a period of the waves [m]
constexpr std::size_t kGrid = 20;

const HeightGrid& waves() {
  static const HeightGrid grid = terrain::sample_function(FunctionName::kWaves, kHalf, kGrid);
  return grid;
}

std::shared_ptr<const Terrain> torus() {
  return std::make_shared<const Terrain>(BicubicSpline(waves(), SplineEnds::kPeriodic));
}

/// Three periods each way, with edges of their own a whole period off the middle one.
std::shared_ptr<const Terrain> tiled_three_by_three() {
  const HeightGrid& one = waves();
  const std::size_t cells = one.columns - 1;
  HeightGrid all = one;
  all.columns = all.rows = 3 * cells + 1;
  all.x_origin = all.y_origin = -3.0 * kHalf;
  all.heights.clear();
  for (std::size_t j = 0; j < all.rows; ++j) {
    for (std::size_t i = 0; i < all.columns; ++i) all.heights.push_back(one.at(i % cells, j % cells));
  }
  return std::make_shared<const Terrain>(BicubicSpline(all));
}

state::Parameters free_wrapping() {
  return {.gravity = 9.81, .drag = 0.0, .friction = 0.0, .thrust_max = 0.0, .edges = state::Edges::kWrap};
}

bool at_home(core::Vec2 p) { return p.x >= -kHalf && p.x < kHalf && p.y >= -kHalf && p.y < kHalf; }

double apart_by_periods(double a, double b) {
  const double turns = (a - b) / (2 * kHalf);
  return std::fabs(turns - std::round(turns)) * 2 * kHalf;
}

/// How far the same louse is off after `seconds` between a map that wraps and one that needs not, at worst;
/// counts the ticks in which it was carried over a seam.
double worst_apart(const std::shared_ptr<const Terrain>& wrapping,
                   const std::shared_ptr<const Terrain>& endless, state::Parameters p,
                   const state::Louse& louse, double seconds, int& crossings) {
  constexpr double kRate = 60;
  World home(wrapping, p, 1 / kRate);
  p.edges = state::Edges::kWalls;
  World away(endless, p, 1 / kRate, tests::kNowhere);
  home.insert(louse);
  away.insert(louse);
  double worst = 0.0;
  core::Vec2 last = louse.position;
  for (int i = 0; i < std::lround(seconds * kRate); ++i) {
    home.step();
    away.step();
    const state::Louse& a = home.lice()[0];
    const state::Louse& b = away.lice()[0];
    REQUIRE(at_home(a.position));
    REQUIRE(a.phase == b.phase);
    if (std::fabs(a.position.x - last.x) > kHalf || std::fabs(a.position.y - last.y) > kHalf) ++crossings;
    last = a.position;
    worst = std::max({worst, apart_by_periods(a.position.x, b.position.x),
                      apart_by_periods(a.position.y, b.position.y), std::fabs(a.velocity.x - b.velocity.x),
                      std::fabs(a.velocity.y - b.velocity.y)});
  }
  return worst;
}

state::Louse random_louse(core::Random& random, double speed) {
  const double angle = 6.283 * random.uniform();
  state::Louse louse =
      tests::moving({kHalf * (1.9 * random.uniform() - 0.95), kHalf * (1.9 * random.uniform() - 0.95)},
                    {speed * std::cos(angle), speed * std::sin(angle)});
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.thrust = {0.3 * std::cos(angle), 0.3 * std::sin(angle)};
  louse.thrust_ticks = state::kHeld;
  return louse;
}

}  // namespace

TEST_CASE(
    "over the seam a louse runs as on three by three copies of the map without a seam, whatever the method") {
  const auto one = torus();
  const auto nine = tiled_three_by_three();
  core::Random random(5);
  for (const state::Method method :
       {state::Method::kStandard, state::Method::kCheap, state::Method::kPrecise}) {
    for (const state::SurfaceContact contact :
         {state::SurfaceContact::kBilateral, state::SurfaceContact::kUnilateral}) {
      int crossings = 0;
      for (int i = 0; i < 20; ++i) {
        const state::Parameters p{.gravity = contact == state::SurfaceContact::kUnilateral ? 3.0 : 9.81,
                                  .drag = 0.1,
                                  .friction = 0.05,
                                  .thrust_max = 4.0,
                                  .edges = state::Edges::kWrap,
                                  .contact = contact,
                                  .method = method};
        INFO(to_text(method) << ", " << to_text(contact) << ", run " << i);
        CHECK(worst_apart(one, nine, p, random_louse(random, 12.0), 2.5, crossings) < 1e-9);
      }
      CHECK(crossings > 6);
    }
  }
}

TEST_CASE("over the seam of a periodic function a louse runs as on the function itself") {
  const auto function = std::make_shared<const Terrain>(FunctionSurface(FunctionName::kWaves, kHalf));
  core::Random random(6);
  int crossings = 0;
  for (int i = 0; i < 10; ++i) {
    const state::Parameters p{
        .gravity = 9.81, .drag = 0.1, .friction = 0.05, .thrust_max = 4.0, .edges = state::Edges::kWrap};
    INFO("run " << i);
    CHECK(worst_apart(function, function, p, random_louse(random, 15.0), 5.0, crossings) < 1e-9);
  }
  CHECK(crossings > 10);
}

TEST_CASE("on a map that wraps every instruction set gives the bits of the scalar step") {
  const auto ground = torus();
  const auto played = [&](InstructionSet set) {
    World world(
        ground,
        {.gravity = 9.81, .drag = 0.05, .friction = 0.05, .thrust_max = 6.0, .edges = state::Edges::kWrap},
        1.0 / 60);
    world.use(set);
    core::Random random(9);
    for (state::LouseId id = 1; id <= 83; ++id) {
      state::Louse louse = random_louse(random, 5.0 + 20.0 * random.uniform());
      louse.id = id;
      world.insert(louse);
    }
    for (int tick = 0; tick < 600; ++tick) world.step();
    for (const state::Louse& louse : world.lice()) REQUIRE(at_home(louse.position));
    return std::vector<state::Louse>(world.lice().begin(), world.lice().end());
  };
  const std::vector<state::Louse> scalar = played(InstructionSet::kScalar);
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (!is_available(set)) continue;
    INFO(to_text(set));
    const std::vector<state::Louse> batched = played(set);
    CHECK(std::memcmp(batched.data(), scalar.data(), scalar.size() * sizeof(state::Louse)) == 0);
  }
}

TEST_CASE("hundreds of crossings leave the energy where it was") {
  const auto function = std::make_shared<const Terrain>(FunctionSurface(FunctionName::kWaves, kHalf));
  // The standard method on the function, precise on the spline: neither loses order at a spline's knot lines.
  for (const auto& [ground, method] :
       {std::pair(function, state::Method::kStandard), std::pair(torus(), state::Method::kPrecise)}) {
    state::Parameters p = free_wrapping();
    p.method = method;
    World world(ground, p, 1.0 / 120);
    world.insert(tests::moving({1.0, 2.0}, {17.0, 11.0}));
    const auto energy = [&] {
      const state::Louse& louse = world.lice()[0];
      const terrain::SurfaceSample s = world.terrain().sample(louse.position.x, louse.position.y);
      return 0.5 * squared_length_in_space(s, louse.velocity) + p.gravity * s.z;
    };
    const double before = energy();
    int crossings = 0;
    core::Vec2 last = world.lice()[0].position;
    for (int i = 0; i < 120 * 400; ++i) {
      world.step();
      const core::Vec2 now = world.lice()[0].position;
      if (std::fabs(now.x - last.x) > kHalf || std::fabs(now.y - last.y) > kHalf) ++crossings;
      last = now;
    }
    INFO(to_text(method));
    CHECK(crossings > 200);
    CHECK(energy() == Approx(before).epsilon(1e-5));
    CHECK(world.counters().bounces == 0);
  }
}

TEST_CASE("a louse that crosses many cells or whole maps in a tick stays on the map and gains nothing") {
  const auto ground = torus();
  const auto& spline = std::get<BicubicSpline>(ground->surface());
  core::Random random(11);
  for (const state::Method method :
       {state::Method::kStandard, state::Method::kCheap, state::Method::kPrecise}) {
    for (const double speed : {400.0, 3e4, 1e7, 1e12}) {
      state::Parameters p = free_wrapping();
      p.method = method;
      World world(ground, p, 1.0 / 60);
      state::Louse louse = random_louse(random, speed);
      louse.thrust_kind = state::ThrustKind::kNone;
      world.insert(louse);
      const double before = tests::energy(spline, louse, 9.81);
      for (int i = 0; i < 30; ++i) {
        world.step();
        INFO(to_text(method) << ", " << speed << " m/s, tick " << i);
        REQUIRE(at_home(world.lice()[0].position));
        // 2e-3 is the cheap step's own error over 400 lines of knots a second; what is capped is bounded to
        // rounding.
        REQUIRE(tests::energy(spline, world.lice()[0], 9.81) <= before * (1 + (speed < 1e3 ? 2e-3 : 1e-9)));
      }
    }
  }
}

TEST_CASE(
    "a position is carried home by whole periods, into the half-open rectangle, whatever rounding does") {
  const terrain::Rectangle odd{-0.3, 0.1, 0.7, 1e6 / 3};
  const Rim rim(odd, state::Edges::kWrap);
  core::Random random(12);
  const auto check = [&](core::Vec2 p, long long x, long long y) {
    core::Vec2 home = p;
    const Turns turns = rim.carry_home(home);
    INFO(p.x << ", " << p.y);
    REQUIRE(home.x >= odd.x_min);
    REQUIRE(home.x < odd.x_max);
    REQUIRE(home.y >= odd.y_min);
    REQUIRE(home.y < odd.y_max);
    CHECK(turns.x == x);
    CHECK(turns.y == y);
    CHECK(home.x + static_cast<double>(turns.x) * (odd.x_max - odd.x_min) == Approx(p.x).margin(1e-9));
  };
  check({odd.x_max, odd.y_max}, 1, 1);
  check({odd.x_min, odd.y_min}, 0, 0);
  check({std::nextafter(odd.x_max, 0.0), std::nextafter(odd.y_max, 0.0)}, 0, 0);
  check({std::nextafter(odd.x_max, 9.0), std::nextafter(odd.y_max, 1e9)}, 1, 1);
  check({odd.x_max + 2.0 * (odd.x_max - odd.x_min) + 0.5, odd.y_min}, 3, 0);
  // A hair below the lower seam there may be no double a period higher that is still below the upper one.
  core::Vec2 below{std::nextafter(odd.x_min, -9.0), std::nextafter(odd.y_min, -9.0)};
  rim.carry_home(below);
  CHECK(rim.interior().contains(below.x, below.y));
  for (int i = 0; i < 2000; ++i) {
    core::Vec2 p{1e3 * (random.uniform() - 0.5), 1e9 * (random.uniform() - 0.5)};
    rim.carry_home(p);
    REQUIRE(rim.interior().contains(p.x, p.y));
  }
}

TEST_CASE("nothing leans on a seam: a louse set down there is at the low rim and rolls over it") {
  World world(
      torus(),
      {.gravity = 9.81, .drag = 0.1, .friction = 0.02, .thrust_max = 6.0, .edges = state::Edges::kWrap},
      1.0 / 60);
  state::Louse louse = tests::moving({kHalf, 3 * kHalf + 1.0}, {});
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.thrust = {-1.0, 0.0};
  louse.thrust_ticks = state::kHeld;
  world.insert(louse);
  CHECK(world.lice()[0].position == core::Vec2{-kHalf, -kHalf + 1.0});
  for (int i = 0; i < 30; ++i) world.step();
  CHECK(world.lice()[0].position.x > 0.9 * kHalf);
  CHECK(world.counters().bounces == 0);
}
