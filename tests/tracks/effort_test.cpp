#include "server/bots/effort.h"

#include <catch2/catch.hpp>

#include <memory>
#include <string>

#include "shared/map/map_file.h"
#include "shared/map/map_text.h"
#include "tests/tracks/game.h"

namespace woodlouse::server::bots {
namespace {

state::Louse louse_at(core::Vec2 position, core::Vec2 velocity = {}) {
  state::Louse louse;
  louse.id = 1;
  louse.position = position;
  louse.velocity = velocity;
  return louse;
}

}  // namespace

TEST_CASE("on level ground the guess is the time that full thrust takes") {
  const auto map = tests::shipped_map("arena");
  const Effort effort(*map, 1.0);
  const Goal goal = Goal::near({10.0, 0.0}, 1.0);
  // 3.5 m/s^2 are left of 4, and the drag takes a little: sqrt(2 * 10 / 3.5) and more.
  const double from_rest = effort.seconds_to(louse_at({0.0, 0.0}), goal);
  CHECK(from_rest > 2.35);
  CHECK(from_rest < 2.8);
  CHECK(effort.seconds_to(louse_at({0.0, 0.0}, {5.0, 0.0}), goal) < from_rest);
  CHECK(effort.seconds_to(louse_at({0.0, 0.0}, {-5.0, 0.0}), goal) > from_rest);
}

TEST_CASE("up a slope that is too steep it takes long, unless there is a run-up") {
  const auto map = tests::shipped_map("parabolic_pot");  // z = r^2 / 40, a slope of 0.5 at 10 m
  const Effort effort(*map, 1.0);
  const Goal up = Goal::near({14.0, 0.0}, 1.0), down = Goal::near({6.0, 0.0}, 1.0);
  CHECK(effort.seconds_to(louse_at({10.0, 0.0}), up) > 5.0);
  CHECK(effort.seconds_to(louse_at({10.0, 0.0}, {9.0, 0.0}), up) < 1.0);
  CHECK(effort.seconds_to(louse_at({10.0, 0.0}), down) < 2.0);
}

TEST_CASE("who is behind a gate heads for a point before it") {
  const auto map = tests::shipped_map("arena");
  const Effort effort(*map, 1.0);
  const Goal goal = Goal::through({{0.0, 3.0}, {0.0, -3.0}, false});  // driven through to the east
  CHECK(goal.way().x == Approx(1.0));
  CHECK(effort.aim(louse_at({-5.0, 1.0}), goal).x == Approx(0.0));
  CHECK(effort.aim(louse_at({-5.0, 1.0}), goal).y == Approx(1.0));
  CHECK(effort.aim(louse_at({5.0, 1.0}), goal).x < -1.0);
}

}  // namespace woodlouse::server::bots
