#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "shared/map/canonical_map.h"
#include "shared/map/map_file.h"

namespace woodlouse::map {
namespace {

const std::filesystem::path kMaps = WOODLOUSE_SOURCE_DIR "/maps";
const char* const kNames[] = {"parabolic_pot", "wavy_pot", "volcano", "hills",       "jumps",
                              "arena",         "kepler",   "torus",   "maunga_whau", "hoffmann_2002"};

}  // namespace

TEST_CASE("every map of the maps folder loads, is named as its file and reads back from its canonical text") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kMaps)) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    INFO(entry.path());
    CHECK(check_map(entry.path()).empty());
    const auto map = load_map(entry.path());
    REQUIRE(map);
    CHECK((*map)->definition.name == entry.path().stem());
    const auto again = parse_map((*map)->canonical, "canonical", {});
    REQUIRE(again);
    CHECK((*again)->canonical == (*map)->canonical);
  }
  CHECK(count >= std::size(kNames));
  for (const char* name : kNames) CHECK(std::filesystem::exists(kMaps / (std::string(name) + ".json")));
}

TEST_CASE("maunga whau is played a tenth of its size, its middle at the origin, its north up") {
  const auto map = load_map(kMaps / "maunga_whau.json");
  REQUIRE(map);
  const auto domain = (*map)->terrain->domain();
  CHECK(domain.x_min == Approx(-43.0));
  CHECK(domain.x_max == Approx(43.0));
  CHECK(domain.y_min == Approx(-30.0));
  CHECK(domain.y_max == Approx(30.0));
  const auto grid = knots_of((*map)->definition);
  const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  CHECK(*low == Approx(9.4));
  CHECK(*high == Approx(19.5));
  CHECK(grid.at(0, grid.rows - 1) == Approx(10.3));    // the file's first number
  CHECK(grid.at(grid.columns - 1, 0) == Approx(9.7));  // and its last
}

TEST_CASE("jacksboro is the part of its fault that make-map was asked for, the hills in its north-west") {
  const auto map = load_map(kMaps / "jacksboro.json");
  REQUIRE(map);
  const auto grid = knots_of((*map)->definition);
  CHECK(grid.columns == 81);
  CHECK(grid.rows == 61);
  const auto domain = (*map)->terrain->domain();
  CHECK(domain.x_max == Approx(46.59).margin(0.01));
  CHECK(domain.y_max == Approx(43.35).margin(0.01));
  const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  CHECK(64.0 * *low == Approx(308.0).margin(0.1));  // metres above the sea, a 64th as high
  CHECK(64.0 * *high == Approx(740.0).margin(0.1));
  for (const double z : grid.heights) REQUIRE(64.0 * z == std::round(64.0 * z));
  // Lice begin where the ground lets them stand.
  for (const SpawnPoint& spawn : (*map)->definition.spawns) {
    const auto ground = (*map)->terrain->sample(spawn.position.x, spawn.position.y);
    CHECK(std::hypot(ground.zx, ground.zy) < 0.05);
  }
}

TEST_CASE("on every shipped map a louse can leave its spawn point") {
  for (const char* name : kNames) {
    INFO(name);
    const auto map = load_map(kMaps / (std::string(name) + ".json"));
    REQUIRE(map);
    const state::Parameters& physics = (*map)->definition.physics;
    for (const SpawnPoint& spawn : (*map)->definition.spawns) {
      const auto ground = (*map)->terrain->sample(spawn.position.x, spawn.position.y);
      const double w2 = 1.0 + ground.zx * ground.zx + ground.zy * ground.zy;
      // Thrust alone beats friction on the flat; on a slope gravity may help, never pin it.
      CHECK(physics.thrust_max > physics.friction * physics.gravity / std::sqrt(w2));
    }
  }
}

}  // namespace woodlouse::map
