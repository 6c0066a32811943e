// Lice on a big map's ground: as on the same heights in memory, and the same bits whatever its tiles go
// through.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include "shared/core/random.h"
#include "shared/physics/world.h"
#include "shared/state/state_hash.h"
#include "shared/terrain/terrain.h"

using namespace woodlouse;
using namespace woodlouse::physics;
using namespace woodlouse::state;
using terrain::HeightGrid;
using terrain::TiledGround;

namespace {

constexpr double kTileTick = 1.0 / 60.0;

/// 300 x 270 knots, half a metre apart: 25 tiles.
HeightGrid hills() {
  HeightGrid grid{300, 270, -75.0, -67.0, 0.5, 0.5, {}};
  for (std::size_t k = 0; k < 300 * 270; ++k) {
    const double x = 0.5 * static_cast<double>(k % 300), y = 0.5 * static_cast<double>(k / 300);
    grid.heights.push_back(2.0 * std::sin(0.21 * x) * std::cos(0.13 * y));
  }
  return grid;
}

std::shared_ptr<const terrain::Terrain> tiled(std::size_t max_tiles) {
  terrain::TiledBSplineOptions options;
  options.no_data = terrain::NoDataPolicy::kFill;
  options.max_tiles = max_tiles;
  return std::make_shared<const terrain::Terrain>(
      TiledGround(std::make_shared<terrain::GridHeights>(hills()), options));
}

/// Thirty lice that drive to and fro.
World peopled(std::shared_ptr<const terrain::Terrain> ground, state::Method method) {
  state::Parameters parameters;
  parameters.method = method;
  World world(std::move(ground), parameters, kTileTick);
  core::Random random(5);
  for (state::LouseId id = 1; id <= 30; ++id) {
    state::Louse louse;
    louse.id = id;
    louse.position = {150.0 * random.uniform() - 75.0, 134.0 * random.uniform() - 67.0};
    louse.velocity = {16.0 * random.uniform() - 8.0, 16.0 * random.uniform() - 8.0};
    world.insert(louse);
  }
  return world;
}

void drive(World& world, int ticks) {
  core::Random random(9);
  for (int tick = 0; tick < ticks; ++tick) {
    if (tick % 40 == 0) {
      for (state::LouseId id = 1; id <= 30; ++id) {
        const double x = random.uniform() - 0.5, y = random.uniform() - 0.5;
        world.set_thrust(id, {state::ThrustKind::kMapVector, {x, y}}, 30);
      }
    }
    world.step();
  }
}

std::uint64_t hash_of(const World& world) {
  core::StableHasher hasher;
  return state::state_hash(hasher, {}, world.lice());
}

terrain::TileStore& store_of(const World& world) {
  return std::get<TiledGround>(world.terrain().surface()).tiles();
}

}  // namespace

TEST_CASE("lice on tiles go where lice on the spline in memory go, with every method") {
  for (const state::Method method :
       {state::Method::kStandard, state::Method::kCheap, state::Method::kPrecise}) {
    World on_tiles = peopled(tiled(100), method);
    World in_memory =
        peopled(std::make_shared<const terrain::Terrain>(terrain::BicubicSpline(hills())), method);
    drive(on_tiles, 120);
    drive(in_memory, 120);
    REQUIRE(on_tiles.counters().louse_steps == in_memory.counters().louse_steps);
    for (std::size_t k = 0; k < 30; ++k) {
      INFO("louse " << k << ", method " << static_cast<int>(method));
      const state::Louse &a = on_tiles.lice()[k], &b = in_memory.lice()[k];
      CHECK(a.position.x == Approx(b.position.x).margin(1e-9));
      CHECK(a.position.y == Approx(b.position.y).margin(1e-9));
      CHECK(a.phase == b.phase);
    }
  }
}

TEST_CASE(
    "the bits are the same with few tiles, with all of them built before, and while another thread prepares "
    "them") {
  World plain = peopled(tiled(100), state::Method::kStandard);
  drive(plain, 300);
  World narrow = peopled(tiled(2), state::Method::kStandard);
  drive(narrow, 300);
  CHECK(store_of(narrow).counters().thrown_out > 100);
  CHECK(hash_of(narrow) == hash_of(plain));

  World prepared = peopled(tiled(100), state::Method::kStandard);
  REQUIRE(store_of(prepared).build_all());
  drive(prepared, 300);
  CHECK(store_of(prepared).counters().built == store_of(prepared).counters().prepared);
  CHECK(hash_of(prepared) == hash_of(plain));

  World accompanied = peopled(tiled(3), state::Method::kStandard);
  std::thread worker([&] {
    for (std::size_t k = 0; k < 500; ++k) store_of(accompanied).prepare(7 * k % 25);
  });
  drive(accompanied, 300);
  worker.join();
  CHECK(hash_of(accompanied) == hash_of(plain));
}
