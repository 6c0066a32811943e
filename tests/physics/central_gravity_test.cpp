// Central gravity and its core against Kepler's ellipse and against what a potential must keep.
#include "shared/physics/central_gravity.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/motion.h"

namespace woodlouse::physics {
namespace {

using tests::moving;

constexpr double kPull = 100.0;
constexpr double kSeconds = 12.0;

state::Parameters pulled(double core_radius = default_core_radius(kPull)) {
  state::Parameters p{0.0, 0.0, 0.0, 0.5, 0.5};
  p.central_gravity = kPull;
  p.core_radius = core_radius;
  return p;
}

double energy_of(const state::Louse& louse, const state::Parameters& p) {
  return 0.5 * dot(louse.velocity, louse.velocity) + central_potential(louse.position, p);
}

/// Runs the ellipse of that periapsis from its apoapsis at 10 m.
template <typename Watch>
tests::Run fall(double periapsis, double rate, const state::Parameters& p, const Watch& watch) {
  const double speed = std::sqrt(kPull * (2.0 / 10.0 - 2.0 / (10.0 + periapsis)));
  return tests::run<Forces<true, true, true, true>>(tests::Plane{}, p, moving({10, 0}, {0, speed}), rate,
                                                    std::lround(kSeconds * rate), tests::kNowhere, watch);
}

/// Where Kepler's ellipse of that periapsis is after kSeconds.
core::Vec2 kepler_after(double periapsis) {
  const double a = 0.5 * (10.0 + periapsis);
  const double e = 1.0 - periapsis / a;
  const double mean =
      3.14159265358979323846 + kSeconds * std::sqrt(kPull / (a * a * a));  // from the periapsis at -x
  double eccentric = mean;
  for (int i = 0; i < 200; ++i)
    eccentric -= (eccentric - e * std::sin(eccentric) - mean) / (1.0 - e * std::cos(eccentric) + 1e-3);
  return {-a * (std::cos(eccentric) - e), -a * std::sqrt(1.0 - e * e) * std::sin(eccentric)};
}

/// How far a louse is from there [m].
double from_kepler(const state::Louse& louse, double periapsis) {
  const core::Vec2 right = kepler_after(periapsis);
  return std::hypot(louse.position.x - right.x, louse.position.y - right.y);
}

}  // namespace

TEST_CASE("the core's pull is its potential's slope, and meets the point's with two derivatives more") {
  const state::Parameters p = pulled(0.3);
  for (const double r : {0.01, 0.1, 0.2, 0.29, 0.31, 1.0, 7.0}) {
    constexpr double kStep = 1e-5;
    const double slope =
        (central_potential(core::Vec2{r + kStep, 0}, p) - central_potential(core::Vec2{r - kStep, 0}, p)) /
        (2 * kStep);
    CHECK(slope == Approx(central_pull(core::Vec2{r, 0}, p) * r).epsilon(1e-6));
  }
  const auto point = [](double r) { return kPull / (r * r * r); };
  const auto bend = [](const auto& f, double r, double d) {
    return (f(r + d) - 2 * f(r) + f(r - d)) / (d * d);
  };
  const auto core = [&](double r) { return central_pull(core::Vec2{r, 0}, p); };
  CHECK(core(0.3 * (1 - 1e-9)) == Approx(point(0.3)).epsilon(1e-7));
  CHECK(bend(core, 0.3, 1e-4) == Approx(bend(point, 0.3, 1e-4)).epsilon(1e-2));
  CHECK(central_potential(core::Vec2{0.3, 0}, p) == Approx(-kPull / 0.3).epsilon(1e-12));
}

TEST_CASE("the default core is the one that 15 ticks a second resolve") {
  CHECK(default_core_radius(kPull) == Approx(0.2281).margin(1e-4));
  for (const double k : {1e-12, 1.0, 100.0, 1e6}) {
    const double radius = default_core_radius(k);
    CHECK(radius * radius * radius == Approx(kCorePull * k / (192.0 * 192.0)).epsilon(1e-12));
    CHECK(resolving_rate(k, radius) == Approx(15.0).epsilon(1e-9));
    CHECK(resolved_core_radius(k, 60.0) < radius);
  }
}

TEST_CASE("no ellipse gains or loses energy, however near it passes, and outside the core it is Kepler's") {
  const double core = default_core_radius(kPull);
  for (const double periapsis : {0.5, 0.125, 0.0545, 0.02, 0.005, 0.0013}) {
    for (const double rate : {15.0, 60.0, 240.0, 1000.0}) {
      INFO("periapsis " << periapsis << " m, " << rate << " Hz");
      const state::Parameters p = pulled();
      const double energy0 = -kPull / (10.0 + periapsis);
      double worst = 0.0;
      const auto run = fall(periapsis, rate, p, [&](const state::Louse& louse) {
        worst = std::fmax(worst, std::fabs(energy_of(louse, p) - energy0));
        return true;
      });
      CHECK(worst < 1e-6 * -energy0);
      CHECK(run.counters.capped == 0);
      if (periapsis > core) CHECK(from_kepler(run.louse, periapsis) < 1e-4);
    }
  }
}

TEST_CASE(
    "a map's own smaller core shows Kepler nearer, and where no step resolves it still nobody gains energy") {
  const state::Parameters p = pulled(0.01);
  for (const double periapsis : {0.125, 0.0545}) {
    for (const double rate : {60.0, 240.0, 1000.0}) {
      INFO("periapsis " << periapsis << " m, " << rate << " Hz");
      const auto run = fall(periapsis, rate, p, [](const state::Louse&) { return true; });
      CHECK(from_kepler(run.louse, periapsis) < 1e-4);
      CHECK(std::fabs(energy_of(run.louse, p) + kPull / (10.0 + periapsis)) < 1e-5);
    }
  }
  for (const double periapsis : {0.02, 0.005, 0.0013}) {
    double highest = -1e9;
    const auto run = fall(periapsis, 15.0, p, [&](const state::Louse& louse) {
      highest = std::fmax(highest, energy_of(louse, p));
      return true;
    });
    CHECK(highest + kPull / (10.0 + periapsis) < 1e-2);
    CHECK(run.counters.sub_steps < 10 * run.counters.louse_steps);  // it passes, and is not caught
  }
}

TEST_CASE("a brake takes energy near the centre at every rate, in every tick, and the louse spirals in") {
  for (const double rate : {15.0, 60.0, 240.0, 1000.0}) {
    INFO(rate << " Hz");
    const state::Parameters p = pulled();
    state::Louse louse = moving({4, 0}, {0, 5});
    louse.thrust = {-1.0, 0.0};
    louse.thrust_kind = state::ThrustKind::kAlongHeading;
    louse.thrust_ticks = state::kHeld;
    double before = energy_of(louse, p);
    const double first = before;
    double rise = 0.0;
    const auto run =
        tests::run<Forces<true, true, true, true>>(tests::Plane{}, p, louse, rate, std::lround(40.0 * rate),
                                                   tests::kNowhere, [&](const state::Louse& l) {
                                                     rise = std::fmax(rise, energy_of(l, p) - before);
                                                     before = energy_of(l, p);
                                                     return true;
                                                   });
    CHECK(rise <= 1e-9);
    CHECK(before < 3.0 * first);
    CHECK(std::hypot(run.louse.position.x, run.louse.position.y) < 2.0);
  }
}

}  // namespace woodlouse::physics
