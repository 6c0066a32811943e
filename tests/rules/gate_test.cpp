#include "shared/rules/gate.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "shared/terrain/function_surface.h"

using namespace woodlouse;
using namespace woodlouse::rules;
using core::Vec2;

namespace {

constexpr double kStep = 1.0 / 60.0;

Vec2 random_place(core::Random& random, double half) {
  return {half * (2.0 * random.uniform() - 1.0), half * (2.0 * random.uniform() - 1.0)};
}

state::Louse louse_at(Vec2 position, Vec2 velocity) {
  state::Louse louse;
  louse.id = 1;
  louse.position = position;
  louse.velocity = velocity;
  const double speed = std::sqrt(core::dot(velocity, velocity));
  louse.heading = (1.0 / speed) * velocity;
  return louse;
}

/// The same step in 64 parts: when its louse is through the gate, as a part of the step.
double reference(const std::shared_ptr<const terrain::Terrain>& terrain, const state::Parameters& physics,
                 const state::Louse& start, const map::Gate& gate) {
  constexpr int kParts = 64;
  physics::World fine(terrain, physics, kStep / kParts);
  fine.insert(start);
  for (int part = 0; part < kParts; ++part) {
    const state::Louse before = fine.lice()[0];
    fine.step();
    const state::Louse& after = fine.lice()[0];
    const auto within = crossing(
        gate, {before.position, before.velocity, after.position, after.velocity, kStep / kParts, true});
    if (within) return (part + *within) / kParts;
  }
  return NAN;
}

}  // namespace

TEST_CASE("a gate's moment is that of the same step made in 64 parts, within a microsecond") {
  const auto terrain = std::make_shared<const terrain::Terrain>(
      terrain::BicubicSpline(terrain::sample_function(terrain::FunctionName::kVolcano, 20.0, 10)));
  const state::Parameters physics;
  core::Random random(7);
  std::vector<double> errors;
  while (errors.size() < 3000) {
    const Vec2 position = random_place(random, 17.0);
    const double speed = 2.0 + 10.0 * random.uniform(), angle = 6.283 * random.uniform();
    const state::Louse start = louse_at(position, {speed * std::cos(angle), speed * std::sin(angle)});
    physics::World world(terrain, physics, kStep);
    world.insert(start);
    world.step();
    const state::Louse& end = world.lice()[0];
    if (world.events()[0] != 0) continue;
    // A gate across the way, somewhere within the step.
    const Vec2 way = end.position - start.position;
    const Vec2 middle = start.position + random.uniform() * way;
    const double length = std::sqrt(core::dot(way, way));
    const Vec2 right{way.y / length, 0.0 - way.x / length};
    const map::Gate gate{middle + -3.0 * right, middle + 3.0 * right, false};
    const auto found =
        crossing(gate, {start.position, start.velocity, end.position, end.velocity, kStep, true});
    const double wanted = reference(terrain, physics, start, gate);
    if (!found || std::isnan(wanted)) continue;  // at the very end of the step: of the next one
    errors.push_back(std::abs(*found - wanted) * kStep);
  }
  std::sort(errors.begin(), errors.end());
  INFO("median " << errors[errors.size() / 2] << " s, p99 " << errors[errors.size() * 99 / 100] << " s, max "
                 << errors.back() << " s");
  CHECK(errors.back() < 1e-6);
}

TEST_CASE("a chord is taken where the way is no cubic") {
  const map::Gate gate{{1, 2}, {1, -2}, false};
  const Way way{{0, 0}, {60, 0}, {4, 0}, {0, 0}, kStep, false};
  CHECK(*crossing(gate, way) == Approx(0.25).epsilon(1e-6));
}

TEST_CASE("each drive through a gate is of one step, wherever steps begin and end") {
  core::Random random(3);
  const map::Gate gate{{0, 1000}, {0, -1000}, false};
  std::size_t wanted = 0, found = 0;
  Vec2 place{-3, 0};
  for (int step = 0; step < 1'000'000; ++step) {
    // Whole numbers: every seventh place is on the gate's line.
    const Vec2 next{std::floor(7.0 * random.uniform()) - 3.0, std::floor(7.0 * random.uniform()) - 3.0};
    const bool is_smooth = random.next() % 2 == 0;
    const Vec2 v0 = random_place(random, 200.0), v1 = random_place(random, 200.0);
    wanted += side_of(gate, place) < 0.0 && side_of(gate, next) >= 0.0;
    const auto fraction = crossing(gate, {place, v0, next, v1, kStep, is_smooth});
    found += fraction.has_value();
    if (fraction) REQUIRE((*fraction > 0.0 && *fraction <= 1.0));
    place = next;
  }
  CHECK(wanted > 100'000);
  CHECK(found == wanted);
}

TEST_CASE("who passes beside a gate has not passed it") {
  const map::Gate gate{{0, 1}, {0, -1}, false};
  for (const double y : {-1.01, 1.01, 5.0, -80.0})
    CHECK_FALSE(crossing(gate, {{-1, y}, {60, 0}, {1, y}, {60, 0}, 1.0 / 30.0, true}));
  for (const double y : {-1.0, 1.0, 0.0})
    CHECK(crossing(gate, {{-1, y}, {60, 0}, {1, y}, {60, 0}, 1.0 / 30.0, true}));
  CHECK_FALSE(crossing(gate, {{1, 0}, {-60, 0}, {-1, 0}, {-60, 0}, 1.0 / 30.0, true}));
}

TEST_CASE("a gate near a seam is seen from the other side of it") {
  const Images images({40.0, 30.0});
  CHECK(images.nearest({1, 1}, {39, 29}) == Vec2{-1, -1});
  CHECK(images.nearest({39, 1}, {1, 29}) == Vec2{41, -1});
  CHECK(images.nearest({20, 15}, {39, 29}) == Vec2{39, 29});
  const Images none({0.0, 0.0});
  CHECK_FALSE(none.wraps());
  CHECK(none.nearest({1, 1}, {39, 29}) == Vec2{39, 29});
}

TEST_CASE("who stays within the margin sees the same image, and steps over no seam") {
  CHECK(std::isinf(Images({0.0, 0.0}).margin2({1, 1}, {39, 29})));
  const Images images({40.0, 30.0});
  core::Random random(5);
  const auto place = [&] { return Vec2{40.0 * random.uniform(), 30.0 * random.uniform()}; };
  int within = 0;
  for (int round = 0; round < 20'000; ++round) {
    const Vec2 from = place(), gate = place(), near = place(), next = place();
    const double margin2 = images.margin2(from, images.nearest(from, gate));
    if (std::max(dot(near - from, near - from), dot(next - from, next - from)) >= margin2) continue;
    ++within;
    REQUIRE(images.shift(near, gate) == images.shift(from, gate));
    REQUIRE(images.nearest(near, next) == next);
  }
  CHECK(within > 100);
}
