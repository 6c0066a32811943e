#include "client/play/ground_words.h"

#include <catch2/catch.hpp>

#include "client/play/bell.h"
#include "client/play/spoken_words.h"
#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

std::shared_ptr<const map::Map> map_of(const char* name) {
  const auto file = map::find_map(name);
  REQUIRE(file);
  auto map = map::load_map(*file);
  REQUIRE(map);
  return *map;
}

}  // namespace

TEST_CASE("it is told where the ground falls, and where the map ends") {
  const auto pot = map_of("parabolic_pot");
  const terrain::Rectangle& domain = pot->terrain->domain();
  const core::Vec2 middle{0.5 * (domain.x_min + domain.x_max), 0.5 * (domain.y_min + domain.y_max)};
  CHECK(words::slope_at(*pot, middle) == "the ground is level");
  CHECK(words::slope_at(*pot, {domain.x_max - 2.0, middle.y}).starts_with("downhill is west, "));
  CHECK(words::slope_at(*pot, {middle.x, domain.y_min + 2.0}).starts_with("downhill is north, "));
  CHECK(words::rim_at(*pot, state::Mode::kRoam, {domain.x_max - 2.0, middle.y}, 3.0) == "a wall 2 m east");
  CHECK(words::rim_at(*pot, state::Mode::kRoam, {domain.x_max - 2.0, middle.y}, 1.0).empty());
  const auto table = map_of("table");
  CHECK(words::rim_at(*table, state::Mode::kHill, {table->terrain->domain().x_min + 1.0, 0.0}, 3.0) ==
        "an edge to fall over 1 m west");
  CHECK(words::rim_at(*table, state::Mode::kRoam, {table->terrain->domain().x_min + 1.0, 0.0}, 3.0) ==
        "a wall 1 m west");
  CHECK(words::rim_at(*map_of("torus"), state::Mode::kRoam, {0.0, 0.0}, 1e6).empty());
}

TEST_CASE("changes of the ground are told, and no flood of them") {
  const auto pot = map_of("parabolic_pot");
  const terrain::Rectangle& domain = pot->terrain->domain();
  const core::Vec2 middle{0.5 * (domain.x_min + domain.x_max), 0.5 * (domain.y_min + domain.y_max)};
  GroundTeller teller;
  const core::Time start{std::chrono::seconds(100)};
  CHECK(teller.news(*pot, state::Mode::kRoam, middle, start) == "the ground is level");
  for (auto t = 50ms; t < 10s; t += 50ms)
    CHECK(teller.news(*pot, state::Mode::kRoam, middle, start + t).empty());
  int lines = 0;
  for (auto t = 10s + 0ms; t < 40s; t += 50ms) {  // round and round, as fast as nobody rolls
    const double angle = std::chrono::duration<double>(t).count() * 6.0;
    const core::Vec2 place =
        middle + 0.5 * (domain.x_max - middle.x) * core::Vec2{std::cos(angle), std::sin(angle)};
    lines += teller.news(*pot, state::Mode::kRoam, place, start + t).empty() ? 0 : 1;
  }
  CHECK(lines >= 8);
  CHECK(lines <= 16);
  const core::Vec2 by_the_wall{domain.x_max - 1.0, middle.y};
  CHECK(teller.news(*pot, state::Mode::kRoam, by_the_wall, start + 40s) == "a wall 1 m east");
  int warnings = 0;
  for (auto t = 40s + 50ms; t < 45s; t += 50ms)
    warnings += teller.news(*pot, state::Mode::kRoam, by_the_wall, start + t).starts_with("a wall") ? 1 : 0;
  CHECK(warnings == 0);
}

TEST_CASE("who watches is told of no key that drives") {
  const KeyLabels labels;
  CHECK(words::keys(labels, SteerBy::kCompass, false) ==
        "keys: Tab where everyone is, T chat, question mark help, Q quit");
  CHECK(words::keys(labels, SteerBy::kHeading, true)
            .starts_with("keys: W push, S brake, A and D turn, Space cruise"));
}

TEST_CASE("the bell is rung for what happens to your own louse") {
  protocol::Event event;
  event.id = 3;
  for (const auto kind : {protocol::EventKind::kFell, protocol::EventKind::kHolds, protocol::EventKind::kRun,
                          protocol::EventKind::kRecord}) {
    event.kind = kind;
    CHECK(rings(event, 3));
    CHECK_FALSE(rings(event, 4));
  }
  event.kind = protocol::EventKind::kGate;
  CHECK_FALSE(rings(event, 3));
  event.kind = protocol::EventKind::kHolds;
  event.id = 0;
  CHECK_FALSE(rings(event, 0));
}
