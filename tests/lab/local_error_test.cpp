// What is told of a tick's error against the true one: a few ticks of what `woodlouse-lab precision --only
// local` measures.
#include "bench/lab/game/local_error.h"

#include <catch2/catch.hpp>

#include "bench/lab/speed/maps.h"

using namespace woodlouse;
using namespace woodlouse::lab;

TEST_CASE("on every shipped map the bound of a tick's error is rarely below it and seldom far above") {
  const auto maps = maps_of({});
  REQUIRE(maps.has_value());
  REQUIRE(maps->size() == 21);
  for (const auto& map : *maps) {
    const auto lice = starting_lice(*map, 5, 8);
    for (const int rate : {15, 60}) {
      LocalErrors all;
      for (const Play play : kPlays) all.add(local_errors(*map, lice, play, rate, 15, 2));
      INFO(map->definition.name << " at " << rate << " Hz: " << all.bounds.size() << " ticks, "
                                << all.too_small() << " too small, median " << all.ratio_at(0.5));
      CHECK(all.bounds.size() > 300);
      CHECK(all.unforeseen * 20 < all.bounds.size());
      CHECK(all.too_small() < 0.01);
      CHECK(all.ratio_at(0.5) <= 100.0);
      CHECK(all.ratio_at(0.5) >= 1.0);
    }
  }
}

TEST_CASE("the reference begins in flight and with a heading of its own") {
  const auto maps = maps_of({});
  REQUIRE(maps.has_value());
  for (const auto& map : *maps) {
    if (map->definition.name != "jumps") continue;
    state::Louse louse = starting_lice(*map, 1, 8)[0];
    louse.phase = state::Phase::kFlying;
    louse.flight_z = 50.0;
    louse.flight_vz = 1.0;
    louse.velocity = {0.5, 0.25};
    reference::Motion flight(*map->terrain, map->definition.physics, louse);
    flight.advance(0.5L, {});
    CHECK(flight.flies());
    const double fallen = 50.0 + 0.5 - 0.125 * map->definition.physics.gravity;
    CHECK(static_cast<double>(flight.height()) == Approx(fallen).epsilon(1e-12));

    louse = starting_lice(*map, 1, 8)[0];
    louse.velocity = {1.0, 0.0};
    louse.heading = {0.0, 1.0};
    louse.thrust_kind = state::ThrustKind::kAlongHeading;
    louse.thrust = {1.0, 0.0};
    reference::Motion turning(*map->terrain, map->definition.physics, louse);
    turning.advance(0.01L, {louse.thrust_kind, louse.thrust});
    louse.heading = {1.0, 0.0};
    reference::Motion straight(*map->terrain, map->definition.physics, louse);
    straight.advance(0.01L, {louse.thrust_kind, louse.thrust});
    CHECK(static_cast<double>(turning.velocity().y - straight.velocity().y) > 0.01);
  }
}
