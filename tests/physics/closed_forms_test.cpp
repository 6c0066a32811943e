// The step against motions that have a closed form.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/motion.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using tests::moving;

namespace {

using Free = Forces<false, false, false>;
using Rough = Forces<false, true, false>;
using RoughInAir = Forces<true, true, false>;

state::Parameters frictionless() { return {.gravity = 9.81, .drag = 0.0, .friction = 0.0}; }

double radius(const state::Louse& l) { return std::hypot(l.position.x, l.position.y); }

}  // namespace

TEST_CASE("a circle in the bowl z = a r^2 turns with omega^2 = 2 a g at any radius") {
  for (const double r : {0.1, 0.5, 2.0}) {
    tests::Bowl bowl;
    bowl.a = 0.5;
    const double omega = std::sqrt(2 * bowl.a * 9.81);
    const double t = 10.0;
    const state::Louse end =
        tests::run<Free>(bowl, frictionless(), moving({r, 0}, {0, r * omega}), 240, 2400).louse;
    CHECK(radius(end) == Approx(r).epsilon(1e-8));
    CHECK(std::hypot(end.position.x - r * std::cos(omega * t), end.position.y - r * std::sin(omega * t)) <
          2e-7 * r);
  }
}

TEST_CASE("a circle on the cone z = k r turns with omega^2 = g k / r") {
  const tests::Cone cone;
  const double r = 1.3;
  const double omega = std::sqrt(9.81 * cone.k / r);
  const state::Louse end =
      tests::run<Free>(cone, frictionless(), moving({r, 0}, {0, r * omega}), 240, 2400).louse;
  CHECK(std::hypot(end.position.x - r * std::cos(omega * 10), end.position.y - r * std::sin(omega * 10)) <
        1e-7);
}

TEST_CASE("a radial swing in the bowl has the period 4 E(-4 a^2 A^2) / sqrt(2 g a)") {
  const tests::Bowl bowl;
  constexpr double kPeriod = 2.296209705227775;  // a = 0.5, A = 0.8
  constexpr long kPeriods = 4;
  constexpr long kTicksPerPeriod = 512;
  const state::Louse end = tests::run<Free>(bowl, frictionless(), moving({0.8, 0}, {}),
                                            kTicksPerPeriod / kPeriod, kPeriods * kTicksPerPeriod)
                               .louse;
  CHECK(end.position.x == Approx(0.8).margin(1e-9));
  CHECK(end.velocity.x == Approx(0.0).margin(1e-7));
  CHECK(end.position.y == 0.0);
}

TEST_CASE("in a cycloid the period is 4 pi sqrt(R / g) at any amplitude") {
  const tests::CycloidGutter cycloid;
  const double period = 4 * 3.14159265358979323846 * std::sqrt(1.0 / 9.81);
  constexpr long kTicks = 1200;
  for (const double amplitude : {0.2, 1.0, 1.9}) {
    const state::Louse end =
        tests::run<Free>(cycloid, frictionless(), moving({amplitude, 0}, {}), kTicks / period, kTicks).louse;
    INFO("amplitude " << amplitude);
    CHECK(end.position.x == Approx(amplitude).margin(1e-8));
    CHECK(end.velocity.x == Approx(0.0).margin(1e-7));
  }
}

TEST_CASE("the angular momentum in an axisymmetric bowl is conserved") {
  const tests::Bowl bowl;
  const state::Louse start = moving({0.8, 0.1}, {-0.3, 1.1});
  const auto momentum = [](const state::Louse& l) {
    return l.position.x * l.velocity.y - l.position.y * l.velocity.x;
  };
  const state::Louse end = tests::run<Free>(bowl, frictionless(), start, 120, 12000).louse;
  CHECK(momentum(end) == Approx(momentum(start)).epsilon(1e-6));
}

TEST_CASE("the velocity along a gutter stays what it was, to the bit") {
  const tests::Gutter gutter;
  double vy = 0.37;
  const state::Louse end =
      tests::run<Free>(gutter, frictionless(), moving({0.8, 0}, {0.2, vy}), 60, 6000).louse;
  CHECK(end.velocity.y == vy);
}

TEST_CASE("without gravity the speed in space is constant, and a cone is run in its unrolled straight line") {
  state::Parameters p = frictionless();
  p.gravity = 0.0;
  const tests::Cone cone;
  const state::Louse start = moving({1.0, 0.0}, {0.3, 0.9});
  const state::Louse end = tests::run<Free>(cone, p, start, 240, 480).louse;
  const auto speed = [&](const state::Louse& l) {
    return std::sqrt(squared_length_in_space(cone.sample(l.position.x, l.position.y), l.velocity));
  };
  CHECK(speed(end) == Approx(speed(start)).epsilon(1e-10));
  // Unrolled: slant distance s = r w, polar angle phi / w, w = sqrt(1 + k^2).
  const double w = std::sqrt(1 + cone.k * cone.k);
  const auto unrolled = [&](const state::Louse& l) {
    const double s = radius(l) * w, angle = std::atan2(l.position.y, l.position.x) / w;
    return core::Vec2{s * std::cos(angle), s * std::sin(angle)};
  };
  const core::Vec2 expected = unrolled(start) + 2.0 * core::Vec2{0.3 * w, 0.9};
  CHECK(unrolled(end).x == Approx(expected.x).margin(1e-8));
  CHECK(unrolled(end).y == Approx(expected.y).margin(1e-8));
}

TEST_CASE("on an incline a louse stops after v^2 / (2 g (mu cos a -+ sin a)), and stays iff tan a <= mu") {
  const double g = 9.81;
  for (const double slope : {0.0, 0.02, 0.049}) {
    for (const double direction : {1.0, -1.0}) {
      tests::Plane plane;
      plane.slope_x = slope;
      state::Parameters p{.gravity = g, .drag = 0.0, .friction = 0.05};
      const double angle = std::atan(slope);
      const state::Louse end =
          tests::run<Rough>(plane, p, moving({}, {direction * 1.5 * std::cos(angle), 0}), 60, 60000).louse;
      const double stop = 2.25 / (2 * g * (0.05 * std::cos(angle) + direction * std::sin(angle)));
      CHECK(end.phase == state::Phase::kResting);
      CHECK(std::fabs(end.position.x) / std::cos(angle) == Approx(stop).epsilon(1e-11));
    }
  }
  tests::Plane steep;
  steep.slope_x = 0.06;
  const state::Parameters p{.gravity = g, .drag = 0.0, .friction = 0.05};
  const double a = std::atan(0.06), deceleration = g * (0.05 * std::cos(a) + std::sin(a));
  const double back = g * (std::sin(a) - 0.05 * std::cos(a));
  const state::Louse end = tests::run<Rough>(steep, p, moving({}, {1.5 * std::cos(a), 0}), 60, 600).louse;
  const double slid = 10.0 - 1.5 / deceleration;
  CHECK(end.phase == state::Phase::kMoving);
  CHECK(end.position.x / std::cos(a) ==
        Approx(1.125 / deceleration - 0.5 * back * slid * slid).epsilon(1e-10));
}

TEST_CASE("started across an incline of tan a = mu, |v| + v_down is constant and half the speed is left") {
  tests::Plane plane;
  plane.slope_x = 0.3;
  const state::Parameters p{.gravity = 9.81, .drag = 0.0, .friction = 0.3};
  const double w = std::sqrt(1 + 0.09);
  double worst = 0.0;
  const auto run = tests::run<Rough>(
      plane, p, moving({}, {0, 2.0}), 60, 6000, tests::kNowhere, [&](const state::Louse& l) {
        const double speed = std::sqrt(squared_length_in_space(plane.sample(0, 0), l.velocity));
        worst = std::fmax(worst, std::fabs(speed - l.velocity.x * w - 2.0));
        return true;
      });
  CHECK(worst < 1e-6);
  CHECK(-run.louse.velocity.x * w == Approx(1.0).epsilon(1e-6));
  CHECK(run.louse.phase == state::Phase::kMoving);
}

TEST_CASE("on the flat, drag and friction stop a louse at the closed form's time and place") {
  const tests::Plane plane;
  const state::Parameters p{.gravity = 9.81, .drag = 0.2, .friction = 0.05};
  const auto run = tests::run<RoughInAir>(plane, p, moving({}, {1.5, 0}), 60, 6000);
  CHECK(run.louse.phase == state::Phase::kResting);
  CHECK(run.louse.position.x == Approx(1.64783986914).margin(1e-9));
  CHECK(static_cast<double>(run.counters.louse_steps) == std::ceil(2.38620188822 * 60));
}

TEST_CASE("down an incline with drag the speed approaches g (sin a - mu cos a) / d") {
  tests::Plane plane;
  plane.slope_x = -0.5;
  const state::Parameters p{.gravity = 9.81, .drag = 0.7, .friction = 0.1};
  const double a = std::atan(0.5);
  const state::Louse end = tests::run<RoughInAir>(plane, p, moving({}, {0.1, 0}), 60, 6000).louse;
  CHECK(end.velocity.x / std::cos(a) ==
        Approx(9.81 * (std::sin(a) - 0.1 * std::cos(a)) / 0.7).epsilon(1e-12));
}

TEST_CASE("the step is of order 4 in position and energy") {
  const tests::Bowl bowl;
  const auto error = [&](double rate) {
    const double omega = std::sqrt(9.81);
    const state::Louse end = tests::run<Free>(bowl, frictionless(), moving({0.5, 0}, {0, 0.5 * omega}), rate,
                                              std::lround(4 * rate))
                                 .louse;
    return std::hypot(end.position.x - 0.5 * std::cos(omega * 4), end.position.y - 0.5 * std::sin(omega * 4));
  };
  CHECK(std::log2(error(100) / error(400)) / 2 == Approx(4.0).margin(0.3));
}
