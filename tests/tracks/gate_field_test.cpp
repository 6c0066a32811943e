#include "server/bots/gate_field.h"

#include <catch2/catch.hpp>

#include "tests/tracks/game.h"

namespace woodlouse::server::bots {

TEST_CASE("a gate's field is the time to drive to it, from before it and round it") {
  const auto map = tests::shipped_map("arena");
  const Effort effort(*map, 1.0);
  const GroundMoves moves(effort);
  const GateField field(moves, {{0.0, 4.0}, {0.0, -4.0}, false}, nullptr);
  const double from_rest = field.seconds({-10.0, 0.0}, {});
  CHECK(from_rest > 2.0);
  CHECK(from_rest < 3.2);
  CHECK(field.seconds({-10.0, 0.0}, {6.0, 0.0}) < from_rest);
  CHECK(field.seconds({-10.0, 0.0}, {-6.0, 0.0}) > from_rest);
  CHECK(field.seconds({-2.0, 0.0}, {6.0, 0.0}) < 0.5);
  CHECK(field.seconds({3.0, 0.0}, {}) > 3.0);  // behind it: round its end
  CHECK(field.course({-10.0, 0.0}, {}).x > 0.7);
}

TEST_CASE("the gate behind a gate makes it dearer to drive through the wrong way") {
  const auto map = tests::shipped_map("arena");
  const Effort effort(*map, 1.0);
  const GroundMoves moves(effort);
  const map::Gate first{{0.0, 4.0}, {0.0, -4.0}, false};
  const GateField north(moves, {{-2.0, 10.0}, {2.0, 10.0}, false}, nullptr);
  const GateField alone(moves, first, nullptr), then(moves, first, &north);
  CHECK(then.seconds({-10.0, 0.0}, {}) > alone.seconds({-10.0, 0.0}, {}) + 1.0);
}

TEST_CASE("what a louse can't climb from rest it reaches by a swing or a run-up, and that takes longer") {
  const auto map = tests::shipped_map("parabolic_pot");  // a slope of 0.5 at 10 m, of 0.7 at 14 m
  const Effort effort(*map, 1.0);
  const GroundMoves moves(effort);
  const GateField field(moves, {{14.0, 4.0}, {14.0, -4.0}, false}, nullptr);
  const double at_its_foot = field.seconds({12.0, 0.0}, {});
  CHECK(at_its_foot < GateField::kFar);
  CHECK(at_its_foot > field.seconds({0.0, 0.0}, {9.0, 0.0}));
  CHECK(field.course({12.0, 0.0}, {}).x < 0.3);  // not straight up
}

}  // namespace woodlouse::server::bots
