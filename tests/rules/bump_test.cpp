#include "shared/rules/bump.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::rules;

namespace {

/// v'G v / 2
double energy(const Body& body) {
  const double rise = core::dot(body.gradient, body.velocity);
  return 0.5 * (core::dot(body.velocity, body.velocity) + rise * rise);
}

struct Scene {
  core::Vec2 between;
  Body first, second;
};

/// Slopes to 60 degrees and a little more, all directions, speeds to 20 m/s.
Scene random_scene(core::Random& random) {
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  const auto vector = [&](double size) { return core::Vec2{symmetric(size), symmetric(size)}; };
  const auto body = [&] { return Body{vector(20.0), vector(1.8 * std::sqrt(0.5))}; };
  return {vector(1.6), body(), body()};
}

}  // namespace

TEST_CASE("a million bumps on slopes never gain energy and are as elastic as they say") {
  core::Random random(1);
  int bumps = 0;
  double most_gain = -1e300, most_gain_elastic = -1e300, worst = 0.0;
  while (bumps < 1'000'000) {
    const Scene scene = random_scene(random);
    const bool is_elastic = bumps % 4 == 0;
    const double e = is_elastic ? 1.0 : 0.99 * random.uniform();
    const auto bumped = bump(scene.between, scene.first, scene.second, e);
    const double u = core::dot(scene.between, scene.second.velocity - scene.first.velocity);
    if (bumped.has_value() != (u < 0.0)) FAIL("only who comes nearer bumps");
    if (!bumped) continue;
    ++bumps;
    const double before = energy(scene.first) + energy(scene.second);
    const double after =
        energy({bumped->first, scene.first.gradient}) + energy({bumped->second, scene.second.gradient});
    const double length = std::sqrt(core::dot(scene.between, scene.between));
    const double parted = core::dot(scene.between, bumped->second - bumped->first);
    // Of the speeds that there are: what doubles round.
    const double scale = length * std::sqrt(2.0 * before);
    worst = std::max(worst, std::abs(parted + e * u) / scale);
    const double gain = (after - before) / before;
    (is_elastic ? most_gain_elastic : most_gain) = std::max(is_elastic ? most_gain_elastic : most_gain, gain);
    if (!(bumped->impulse > 0.0)) FAIL("an impulse parts them");
  }
  INFO("gain " << most_gain << ", elastic " << most_gain_elastic << ", restitution " << worst);
  CHECK(most_gain <= 1e-15);
  CHECK(most_gain_elastic <= 2e-15);
  CHECK(worst <= 1e-12);
}

TEST_CASE("a bump is the same whoever of the two is called the first") {
  core::Random random(2);
  for (int k = 0; k < 100'000; ++k) {
    const Scene scene = random_scene(random);
    const auto one = bump(scene.between, scene.first, scene.second, 0.8);
    const auto other = bump(-scene.between, scene.second, scene.first, 0.8);
    REQUIRE(one.has_value() == other.has_value());
    if (!one) continue;
    REQUIRE(one->first == other->second);
    REQUIRE(one->second == other->first);
    REQUIRE(one->impulse == other->impulse);
  }
}

TEST_CASE("equal lice on the level exchange what is left of their approach, and nobody turns aside") {
  const auto bumped = bump({0.5, 0}, {{3, 1}, {}}, {{-1, 2}, {}}, 0.5);
  REQUIRE(bumped);
  CHECK(bumped->first == core::Vec2{0, 1});
  CHECK(bumped->second == core::Vec2{2, 2});
  CHECK(bumped->impulse == 3.0);
  CHECK_FALSE(bump({0.5, 0}, {{-1, 1}, {}}, {{3, 2}, {}}, 0.5));
  CHECK_FALSE(bump({0.5, 0}, {{1, 0}, {}}, {{1, 9}, {}}, 0.5));
}

TEST_CASE("lice in one place bump as if one stood east of the other, or not at all") {
  CHECK_FALSE(bump({}, {}, {}, 0.8));
  CHECK_FALSE(bump({1e-13, -1e-13}, {{-1, 0}, {}}, {{1, 0}, {}}, 0.8));
  for (const core::Vec2 between : {core::Vec2{}, core::Vec2{0, 1e-200}, core::Vec2{-1e-160, 1e-170}}) {
    const auto bumped = bump(between, {{2, 5}, {}}, {{0, -5}, {}}, 1.0);
    REQUIRE(bumped);
    CHECK(bumped->first == core::Vec2{0, 5});
    CHECK(bumped->second == core::Vec2{2, -5});
  }
}
