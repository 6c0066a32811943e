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

TEST_CASE("a motion that is set moves a louse at rest, turns it, and marks its block alone") {
  World world(volcano(), {.friction = 1.5}, 1.0 / 60);
  for (state::LouseId id = 1; id <= 3 * kBlockLice; ++id) {
    state::Louse louse;
    louse.id = id;
    louse.position = {-15.0 + 0.1 * id, 18.0};
    world.insert(louse);
  }
  world.step();
  REQUIRE(world.stands_still());
  world.forget_changes();
  const state::LouseId id = kBlockLice + 7;
  CHECK(world.set_motion(id, {1, 2}, {0, -3}));
  CHECK(world.changed_blocks()[0] == 0);
  CHECK(world.changed_blocks()[1] == 1);
  CHECK(world.changed_blocks()[2] == 0);
  const state::Louse* louse = world.find(id);
  REQUIRE(louse != nullptr);
  CHECK(louse->phase == state::Phase::kMoving);
  CHECK(louse->position == core::Vec2{1, 2});
  CHECK(louse->velocity == core::Vec2{0, -3});
  CHECK(louse->heading == core::Vec2{0, -1});
  CHECK_FALSE(world.stands_still());
  world.step();
  CHECK(world.find(id)->position.y < 1.96);
  CHECK_FALSE(world.set_motion(9999, {}, {}));
}

TEST_CASE("a motion that is set to nothing puts a louse to rest where friction holds it, and it looks on") {
  World world(volcano(), {.friction = 1.5}, 1.0 / 60);
  state::Louse louse;
  louse.id = 1;
  louse.position = {3, 3};
  louse.velocity = {2, 0};
  world.insert(louse);
  world.step();
  const core::Vec2 heading = world.lice()[0].heading;
  world.set_motion(1, {3, 3}, {});
  CHECK(world.lice()[0].phase == state::Phase::kResting);
  CHECK(world.lice()[0].heading == heading);
  world.step();
  CHECK(world.stands_still());
  CHECK(world.lice()[0].position == core::Vec2{3, 3});
}

TEST_CASE("a thrust that turns a heading keeps it when a motion is set, but in flight") {
  state::Parameters p;
  p.contact = state::SurfaceContact::kUnilateral;
  World world(volcano(), p, 1.0 / 60);
  for (const state::Phase phase : {state::Phase::kMoving, state::Phase::kFlying}) {
    state::Louse louse;
    louse.id = phase == state::Phase::kMoving ? 1 : 2;
    louse.phase = phase;
    louse.position = {3, 3};
    louse.flight_z = phase == state::Phase::kFlying ? 90.0 : 0.0;
    louse.velocity = {2, 0};
    world.insert(louse);
    world.set_thrust(louse.id, {state::ThrustKind::kAlongHeading, {1, 0}}, state::kHeld);
    world.set_motion(louse.id, {3, 4}, {0, 5});
    CHECK(world.find(louse.id)->phase == phase);
    CHECK(world.find(louse.id)->flight_z == louse.flight_z);
  }
  CHECK(world.find(1)->heading == core::Vec2{1, 0});
  CHECK(world.find(2)->heading == core::Vec2{0, 1});
}

TEST_CASE("a motion that is set is the one of a louse that was inserted so") {
  World set(volcano(), {}, 1.0 / 60), inserted(volcano(), {}, 1.0 / 60);
  core::Random random(9);
  for (state::LouseId id = 1; id <= 50; ++id) {
    const state::Louse louse = random_louse(random, id);
    state::Louse other = louse;
    other.position = {};
    other.velocity = {1, 1};
    set.insert(other);
    set.set_motion(id, louse.position, louse.velocity);
    state::Louse as_set = louse;
    as_set.heading = set.find(id)->heading;
    inserted.insert(as_set);
  }
  for (int i = 0; i < 100; ++i) {
    set.step();
    inserted.step();
  }
  CHECK(same_bits(set.lice(), inserted.lice()));
}
