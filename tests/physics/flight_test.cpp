// Unilateral contact and central gravity: closed forms 10 and 11.
#include "shared/physics/flight.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"
#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/function_surface.h"
#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using tests::moving;

namespace {

using Free = Forces<false, false, false>;

state::Parameters unilateral() {
  return {.gravity = 9.81,
          .drag = 0.0,
          .friction = 0.0,
          .thrust_max = 0.0,
          .contact = state::SurfaceContact::kUnilateral};
}

/// The upper half of a sphere, and flat ground outside of it.
struct Sphere : tests::Unbounded {
  double radius = 1.0;
  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    const double z2 = radius * radius - x * x - y * y;
    if (z2 <= 1e-6) return {0, 0, 0, 0, 0, 0};
    const double z = std::sqrt(z2), z3 = z2 * z;
    return {z, -x / z, -y / z, -(z2 + x * x) / z3, -x * y / z3, -(z2 + y * y) / z3};
  }
};

}  // namespace

TEST_CASE(
    "a louse leaves a sphere where cos t = (2 + v0^2 / (g R)) / 3, and flies the exact parabola from there") {
  const Sphere sphere;
  const double v0 = GENERATE(0.3, 1.0, 2.0);
  const double cosine = (2 + v0 * v0 / 9.81) / 3;
  const double speed = std::sqrt(9.81 * cosine);  // g cos t = v^2 / R there
  const double sine = std::sqrt(1 - cosine * cosine);
  const auto run = tests::run<Free>(sphere, unilateral(), moving({0, 0}, {v0, 0}), 960, 9600, tests::kNowhere,
                                    [](const state::Louse& l) { return l.phase != state::Phase::kFlying; });
  const state::Louse& l = run.louse;
  // Horizontal speed and total energy are the parabola's invariants.
  CHECK(l.velocity.x == Approx(speed * cosine).epsilon(1e-8));
  const double energy = 0.5 * (l.velocity.x * l.velocity.x + l.flight_vz * l.flight_vz) + 9.81 * l.flight_z;
  CHECK(energy == Approx(0.5 * v0 * v0 + 9.81).epsilon(1e-9));
  const double t = (l.position.x - sine) / l.velocity.x;
  CHECK(l.flight_z == Approx(cosine - speed * sine * t - 0.5 * 9.81 * t * t).margin(1e-8));
}

TEST_CASE("from z = -a r^2 a louse takes off at the top iff v0^2 > g / (2 a)") {
  tests::Bowl hill;
  hill.a = -0.5;
  const double limit = std::sqrt(9.81 / (2 * 0.5));
  for (const double factor : {0.5, 0.99, 1.01, 2.0}) {
    const auto run = tests::run<Free>(hill, unilateral(), moving({0, 0}, {factor * limit, 0}), 240, 120);
    INFO("factor " << factor);
    CHECK((run.counters.flights > 0) == (factor > 1.0));
  }
}

TEST_CASE("a bilateral bead stays on the same hill") {
  tests::Bowl hill;
  hill.a = -0.5;
  state::Parameters p = unilateral();
  p.contact = state::SurfaceContact::kBilateral;
  CHECK(tests::run<Free>(hill, p, moving({0, 0}, {10, 0}), 240, 60).counters.flights == 0);
}

TEST_CASE("a landing takes the velocity along the normal and nothing else, and never adds energy") {
  core::Random random(3);
  const auto u = [&] { return 4 * random.uniform() - 2; };
  for (int i = 0; i < 2000; ++i) {
    const terrain::SlopeSample s{u(), u(), u()};
    Flight flight{{{0, 0}, {u(), u()}}, s.z, 0};
    flight.climb = s.zx * flight.over.velocity.x + s.zy * flight.over.velocity.y - std::fabs(u());
    const core::Vec2 v = landed_velocity(s, flight);
    const core::Vec2 w = flight.over.velocity;
    // What is lost points along n.
    const double lost_x = w.x - v.x, lost_y = w.y - v.y, lost_z = flight.climb - (s.zx * v.x + s.zy * v.y);
    CHECK(lost_x == Approx(-s.zx * lost_z).margin(1e-12));
    CHECK(lost_y == Approx(-s.zy * lost_z).margin(1e-12));
    CHECK(squared_length_in_space(s, v) <= dot(w, w) + flight.climb * flight.climb + 1e-12);
  }
}

TEST_CASE("jumping lice never gain energy, never leave the walls and never end below the ground") {
  const terrain::BicubicSpline hills(terrain::sample_function(terrain::FunctionName::kHills, 20.0, 10));
  core::Random random(5);
  std::uint64_t flights = 0;
  for (int i = 0; i < 40; ++i) {
    const double angle = 6.28 * random.uniform();
    const state::Louse start = moving({30 * random.uniform() - 15, 30 * random.uniform() - 15},
                                      {25 * std::cos(angle), 25 * std::sin(angle)});
    const auto total = [&](const state::Louse& l) {
      if (l.phase != state::Phase::kFlying) return tests::energy(hills, l, 9.81);
      return 0.5 * (dot(l.velocity, l.velocity) + l.flight_vz * l.flight_vz) + 9.81 * l.flight_z;
    };
    double last = total(start);
    double worst = 0.0;
    bool sound = true;
    const auto run =
        tests::run<Free>(hills, unilateral(), start, 60, 900, hills.domain(), [&](const state::Louse& l) {
          worst = std::fmax(worst, total(l) - last);
          last = total(l);
          sound = sound && hills.domain().contains(l.position.x, l.position.y);
          if (l.phase == state::Phase::kFlying)
            sound = sound && l.flight_z >= hills.sample(l.position.x, l.position.y).z - 1e-9;
          return true;
        });
    INFO("run " << i);
    CHECK(sound);
    CHECK(worst < 2e-2);  // J/kg in a tick, of 300 and more
    flights += run.counters.flights;
  }
  CHECK(flights >= 20);
}

/// Nothing but a pull towards the middle.
constexpr state::Parameters kPlanet{.gravity = 0.0,
                                    .drag = 0.0,
                                    .friction = 0.0,
                                    .thrust_max = 0.0,
                                    .central_gravity = 1.0,
                                    .core_radius = 0.05};

TEST_CASE(
    "Kepler: a louse on the flat under central gravity runs its ellipse, with period, axis and Laplace "
    "vector") {
  const tests::Plane plane;
  for (const double v0 : {0.8, 1.0, 1.2}) {
    const double a = 1 / (2 - v0 * v0);
    const double period = 2 * 3.14159265358979323846 * std::pow(a, 1.5);
    constexpr long kTicks = 4000;
    const auto run = tests::run<Forces<false, false, false, true>>(plane, kPlanet, moving({1, 0}, {0, v0}),
                                                                   kTicks / period, kTicks);
    const state::Louse& l = run.louse;
    INFO("v0 " << v0);
    CHECK(std::hypot(l.position.x - 1, l.position.y) < 1e-8);
    const double momentum = l.position.x * l.velocity.y - l.position.y * l.velocity.x;
    const double r = std::hypot(l.position.x, l.position.y);
    CHECK(l.velocity.y * momentum - l.position.x / r == Approx(v0 * v0 - 1).margin(1e-9));
    CHECK(-l.velocity.x * momentum - l.position.y / r == Approx(0.0).margin(1e-8));
  }
}

TEST_CASE("falling into the centre stays finite") {
  const tests::Plane plane;
  bool finite = true;
  tests::run<Forces<false, false, false, true>>(
      plane, kPlanet, moving({1, 0}, {0, 0}), 60, 600, {-2, -2, 2, 2}, [&](const state::Louse& l) {
        finite = finite && std::fabs(l.position.x) <= 2 && std::fabs(l.velocity.x) < 1e4;
        return true;
      });
  CHECK(finite);
}

TEST_CASE("a hop that ends within the first piece of a flight lands where the parabola meets the ground") {
  const terrain::HeightGrid flat{5, 5, -20.0, -20.0, 10.0, 10.0, std::vector<double>(25, 1.0)};
  const terrain::BicubicSpline ground(flat);
  const state::Parameters p;
  const Rim rim(ground.domain(), state::Edges::kWalls);
  for (const double climb : {1e-4, 0.003, 0.05}) {
    Flight flight{{{2.0, 3.0}, {5.0, -1.0}}, 1.0, climb};
    const auto piece = Flyer<terrain::BicubicSpline>(ground, p, rim, 1.0 / 20).fly(flight, 1.0 / 20);
    CHECK(piece.landed);
    CHECK(piece.time == Approx(2 * climb / p.gravity).margin(1e-11));  // the height, 1, is rounded to 1e-16
    CHECK(flight.over.position.x == Approx(2.0 + 5.0 * piece.time).epsilon(1e-12));
    CHECK(flight.height == Approx(1.0).epsilon(1e-12));
  }
}
