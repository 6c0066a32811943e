// What a step errs, as it can tell itself, and maps that bear only so much of it.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "shared/physics/nystrom.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/world.h"
#include "shared/terrain/function_surface.h"
#include "shared/terrain/terrain.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using core::Vec2;

namespace {

/// A motion by Nystrom-4 over h and what it says that it errs.
struct Told {
  Motion end;
  double astray;
};
template <typename Acceleration>
Told step(const Motion& start, double h, const Acceleration& acceleration) {
  const Vec2 a1 = acceleration(start);
  const Vec2 middle = nystrom_middle(start, a1, h);
  const Vec2 v = start.velocity;
  const Vec2 a2 = acceleration({middle, v + 0.5 * h * a1});
  const Vec2 a3 = acceleration({middle, v + 0.5 * h * a2});
  const Vec2 a4 = acceleration({nystrom_last(start, a3, h), v + h * a3});
  const Motion end = nystrom_end(start, a1, a2, a3, a4, h);
  return {end, astray(start, a1, end, h, [&](double, const Motion& at) { return acceleration(at); })};
}

double apart(const Motion& a, const Motion& b) {
  const Vec2 x = a.position - b.position, v = a.velocity - b.velocity;
  return std::hypot(x.x, x.y) + kAhead * std::hypot(v.x, v.y);
}

/// The same in very many steps.
template <typename Acceleration>
Motion followed(Motion at, double h, const Acceleration& acceleration) {
  constexpr int kParts = 2000;
  for (int part = 0; part < kParts; ++part) at = step(at, h / kParts, acceleration).end;
  return at;
}

state::Louse pushed(Vec2 place, Vec2 velocity, state::LouseId id, state::ThrustKind kind) {
  state::Louse louse;
  louse.id = id;
  louse.position = place;
  louse.velocity = velocity;
  louse.heading = {0.6, 0.8};
  louse.thrust_kind = kind;
  if (kind == state::ThrustKind::kNone) return louse;
  louse.thrust = {0.5, kind == state::ThrustKind::kMapVector ? 0.25 : 0.0};
  louse.thrust_ticks = state::kHeld;
  return louse;
}

/// A lively herd on hills, of each kind of thrust.
std::vector<state::Louse> herd() {
  std::vector<state::Louse> lice;
  for (state::LouseId id = 1; id <= 30; ++id) {
    const auto kind = id % 3 == 0   ? state::ThrustKind::kNone
                      : id % 3 == 1 ? state::ThrustKind::kMapVector
                                    : state::ThrustKind::kAlongHeading;
    lice.push_back(pushed({1.1 * id - 17.0, 9.0 - 0.6 * id}, {std::sin(1.0 * id) * 5, std::cos(2.0 * id) * 5},
                          id, kind));
  }
  return lice;
}

World hills(const state::Parameters& p, double tick) {
  return {std::make_shared<const terrain::Terrain>(
              terrain::BicubicSpline(terrain::sample_function(terrain::FunctionName::kHills, 20.0, 20))),
          p, tick};
}

state::Parameters with(double tolerance, state::Method method = state::Method::kStandard) {
  state::Parameters p;
  p.tolerance = tolerance;
  p.method = method;
  return p;
}

/// The herd after a tick, made in so many parts.
std::vector<state::Louse> after_a_tick(const state::Parameters& p, const std::vector<state::Louse>& lice,
                                       double tick, int parts) {
  World world = hills(p, tick / parts);
  world.restore(lice);
  for (int part = 0; part < parts; ++part) world.step();
  return {world.lice().begin(), world.lice().end()};
}

}  // namespace

TEST_CASE("the quintic through both ends is the motion itself where that is a quintic") {
  const auto at = [](double t) {
    return Motion{{1 + t * (2 + t * (-1 + t * (0.5 + t * (3 - 2 * t)))), t * t * t * t * t},
                  {2 + t * (-2 + t * (1.5 + t * (12 - 10 * t))), 5 * t * t * t * t}};
  };
  const auto accelerated = [](double t) { return Vec2{-2 + t * (3 + t * (36 - 40 * t)), 20 * t * t * t}; };
  const double from = 0.3, h = 0.7;
  for (const double s : {0.0, kEarly, 0.5, kLate, 1.0}) {
    const Motion m = on_quintic(at(from), accelerated(from), at(from + h), accelerated(from + h), h, s);
    CHECK(apart(m, at(from + s * h)) < 1e-13);
  }
}

TEST_CASE("a step tells what it errs, of order 5, to a factor of three or so") {
  // Positions and velocities both count, and it is no quadrature alone, nor does one come out right by it.
  const auto swing = [](const Motion& m) { return -4.0 * m.position - 0.3 * m.velocity; };
  const auto bumps = [](const Motion& m) {
    return Vec2{std::sin(3.0 * m.position.x), std::cos(m.position.x + m.position.y)};
  };
  const auto turns = [](const Motion& m) { return Vec2{-2.0 * m.velocity.y, 2.0 * m.velocity.x}; };
  const auto check = [](const auto& acceleration) {
    const Motion start{{0.4, -0.2}, {2.0, 1.0}};
    double last = 0.0;
    for (double h = 0.05; h > 0.01; h *= 0.5) {
      const Told told = step(start, h, acceleration);
      const double truth = apart(told.end, followed(start, h, acceleration));
      INFO("h " << h);
      CHECK(told.astray > 0.3 * truth);
      CHECK(told.astray < 1.4 * truth);
      if (last > 0.0) CHECK(last / told.astray == Approx(32).epsilon(0.4));
      last = told.astray;
    }
  };
  check(swing);
  check(bumps);
  check(turns);
}

TEST_CASE("a step tells what it errs at a kink of the acceleration, such as knot lines make") {
  int seen = 0, places = 0;
  for (double kink = 0.02; kink < 1.0; kink += 0.02) {
    const auto kinked = [&](const Motion& m) {
      return Vec2{m.position.x < kink ? 0.0 : 3.0 * (m.position.x - kink), 0.0};
    };
    const Motion start{{0.0, 0.0}, {1.0, 0.0}};
    const Told told = step(start, 1.0, kinked);
    const double truth = apart(told.end, followed(start, 1.0, kinked));
    ++places;
    seen += 2.0 * told.astray >= truth ? 1 : 0;
    CHECK(told.astray < 20 * truth + 0.02);
  }
  CHECK(seen >= 0.9 * places);
}

TEST_CASE("steps are shortened until a map bears what they err, whatever the rate, method and thrust") {
  const std::vector<state::Louse> lice = herd();
  for (const state::Method method :
       {state::Method::kStandard, state::Method::kCheap, state::Method::kPrecise}) {
    for (const double tolerance : {1e-2, 1e-4}) {
      for (const double rate : {15.0, 60.0}) {
        INFO(state::to_text(method) << ", " << tolerance << ", " << rate << " Hz");
        const double tick = 1.0 / rate;
        const auto truth = after_a_tick(with(0.0), lice, tick, 4000);
        const auto kept = after_a_tick(with(tolerance, method), lice, tick, 1);
        int beyond = 0;
        for (std::size_t i = 0; i < lice.size(); ++i) {
          const Motion a{kept[i].position, kept[i].velocity}, b{truth[i].position, truth[i].velocity};
          beyond += apart(a, b) > tolerance * tick ? 1 : 0;
        }
        CHECK(beyond == 0);
      }
    }
  }
}

TEST_CASE("a tolerance costs sub-steps where it is needed and none where it is not") {
  const std::vector<state::Louse> lice = herd();
  const auto sub_steps = [&](double tolerance) {
    World world = hills(with(tolerance), 1.0 / 15);
    world.restore(lice);
    world.step();
    return world.counters().sub_steps;
  };
  CHECK(sub_steps(1.0) == sub_steps(0.0));
  CHECK(sub_steps(1e-3) > sub_steps(1.0));
  CHECK(sub_steps(1e-5) > sub_steps(1e-3));
}

TEST_CASE("a tolerance that nothing meets ends at the shortest steps, and the tick is whole") {
  const std::vector<state::Louse> lice = herd();
  const double tick = 1.0 / 15;
  World world = hills(with(1e-300), tick);
  world.restore(lice);
  world.step();
  CHECK(world.counters().sub_steps <= 256 * lice.size());
  const auto truth = after_a_tick(with(0.0), lice, tick, 4000);
  for (std::size_t i = 0; i < lice.size(); ++i) {
    const Motion a{world.lice()[i].position, world.lice()[i].velocity},
        b{truth[i].position, truth[i].velocity};
    CHECK(apart(a, b) < 1e-6);
  }
}

TEST_CASE("the next step is as long as order 4 lets expect, and never longer than a tick") {
  const double tick = 1.0 / 64;
  const SubStepRules rules(with(1e-3), 1.0, tick);
  const double h = tick / 8;
  const double borne = 0.33 * 1e-3 * h;
  CHECK(rules.bears(borne, h));
  CHECK_FALSE(rules.bears(1.1 * borne, h));
  CHECK_FALSE(rules.bears(std::nan(""), h));
  CHECK(rules.borne_length(borne, h, tick) == h);
  CHECK(rules.borne_length(0.0, h, tick) == tick);
  CHECK(rules.borne_length(borne / 100, h, tick) == 2 * h);
  CHECK(rules.borne_length(1.1 * borne, h, tick) == h / 2);
  CHECK(rules.borne_length(17 * borne, h, tick) == h / 4);
  CHECK(rules.borne_length(std::nan(""), h, tick) == tick / 128);
  CHECK(rules.bears(1.0, tick / 128));
}
