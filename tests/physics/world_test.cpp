#include "shared/physics/world.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <memory>

#include "shared/core/random.h"
#include "shared/state/state_hash.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::BicubicSpline;
using terrain::FunctionName;
using terrain::Terrain;

namespace {

std::shared_ptr<const Terrain> volcano() {
  return std::make_shared<const Terrain>(
      BicubicSpline(terrain::sample_function(FunctionName::kVolcano, 20.0, 10)));
}

state::Louse random_louse(core::Random& random, state::LouseId id) {
  state::Louse louse;
  louse.id = id;
  louse.position = {38 * random.uniform() - 19, 38 * random.uniform() - 19};
  louse.velocity = {4 * random.uniform() - 2, 4 * random.uniform() - 2};
  louse.thrust = {random.uniform() - 0.5, random.uniform() - 0.5};
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.thrust_ticks = state::kHeld;
  return louse;
}

bool same_bits(std::span<const state::Louse> a, std::span<const state::Louse> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

}  // namespace

TEST_CASE("the same inputs give the same bits, in whatever order lice were inserted") {
  core::Random random(1);
  std::vector<state::Louse> lice;
  for (state::LouseId id = 1; id <= 200; ++id) lice.push_back(random_louse(random, id));
  World forward(volcano(), {}, 1.0 / 60);
  World backward(volcano(), {}, 1.0 / 60);
  for (std::size_t i = 0; i < lice.size(); ++i) {
    forward.insert(lice[i]);
    backward.insert(lice[lice.size() - 1 - i]);
  }
  for (int i = 0; i < 300; ++i) {
    forward.step();
    backward.step();
  }
  CHECK(same_bits(forward.lice(), backward.lice()));
}

TEST_CASE("a louse moves the same alone as among others: what a client predicts is what the server steps") {
  core::Random random(2);
  World crowd(volcano(), {}, 1.0 / 60);
  const state::Louse mine = random_louse(random, 50);
  for (state::LouseId id = 1; id <= 100; ++id) crowd.insert(id == 50 ? mine : random_louse(random, id));
  World alone(volcano(), {}, 1.0 / 60);
  alone.insert(mine);
  for (int i = 0; i < 600; ++i) {
    crowd.step();
    alone.step();
  }
  CHECK(std::memcmp(crowd.find(50), alone.find(50), sizeof(state::Louse)) == 0);
}

TEST_CASE("resting lice are not stepped") {
  World world(volcano(), {.friction = 1.5, .thrust_max = 0.0}, 1.0 / 60);
  core::Random random(3);
  for (state::LouseId id = 1; id <= 50; ++id) {
    state::Louse louse = random_louse(random, id);
    louse.thrust = {};
    louse.thrust_kind = state::ThrustKind::kNone;
    world.insert(louse);
  }
  for (int i = 0; i < 600; ++i) world.step();
  for (const state::Louse& louse : world.lice()) REQUIRE(louse.phase == state::Phase::kResting);
  const auto steps = world.counters().louse_steps;
  for (int i = 0; i < 100; ++i) world.step();
  CHECK(world.counters().louse_steps == steps);
}

TEST_CASE("lice come and go by id, and a place outside the domain is moved in") {
  World world(volcano(), {}, 1.0 / 60);
  state::Louse louse;
  louse.id = 7;
  louse.position = {100.0, -3.0};
  world.insert(louse);
  CHECK(world.find(7)->position == core::Vec2{20.0, -3.0});
  CHECK(world.find(8) == nullptr);
  CHECK_FALSE(world.set_thrust(8, {}, state::kHeld));
  CHECK_FALSE(world.erase(8));
  CHECK(world.erase(7));
  CHECK(world.lice().empty());
}

TEST_CASE("the distance travelled is the length of the path in space") {
  // Down a plane of the pot's rim at constant slope there is a closed form only for the flat: v t.
  World world(std::make_shared<const Terrain>(
                  BicubicSpline(terrain::HeightGrid{5, 5, 0, 0, 10, 10, std::vector<double>(25, 2.0)})),
              {.drag = 0.0, .friction = 0.0, .thrust_max = 0.0}, 1.0 / 60);
  state::Louse louse;
  louse.id = 1;
  louse.position = {5, 5};
  louse.velocity = {3, 4};
  world.insert(louse);
  for (int i = 0; i < 60; ++i) world.step();
  CHECK(world.find(1)->distance == Approx(5.0).epsilon(1e-12));
}

TEST_CASE("every method steps the same game: cheap near standard, precise nearer") {
  const auto end = [](state::Method method, double rate) {
    World world(volcano(), {.friction = 0.0, .method = method}, 1.0 / rate);
    state::Louse louse;
    louse.id = 1;
    louse.position = {12.0, 0.0};
    louse.velocity = {0.0, 6.0};
    world.insert(louse);
    for (int i = 0; i < static_cast<int>(4 * rate); ++i) world.step();
    return world.find(1)->position;
  };
  const core::Vec2 exact = end(state::Method::kPrecise, 1920);
  const auto error = [&](state::Method method) {
    const core::Vec2 e = end(method, 60) - exact;
    return std::sqrt(dot(e, e));
  };
  CHECK(error(state::Method::kCheap) < 0.05);
  CHECK(error(state::Method::kStandard) < 0.1 * error(state::Method::kCheap));
  CHECK(error(state::Method::kPrecise) < error(state::Method::kStandard));
}
