#include "server/room/places.h"

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;
using state::Role;

TEST_CASE("players, bots and spectators have places of their own") {
  protocol::Limits limits;
  limits.max_players = 1;
  limits.max_bots = 2;
  limits.max_spectators = 0;
  Places places;
  CHECK_FALSE(places.has_one(Role::kSpectator, 1, limits));
  places.take(Role::kPlayer, 1);
  CHECK_FALSE(places.has_one(Role::kPlayer, 2, limits));
  CHECK(places.has_one(Role::kBot, 1, limits));
  places.give_back(Role::kPlayer, 1);
  CHECK(places.has_one(Role::kPlayer, 2, limits));
}

TEST_CASE("the last twentieth is for addresses that have nobody there") {
  protocol::Limits limits;
  limits.max_players = 100;
  Places places;
  for (int k = 0; k < 95; ++k) {
    REQUIRE(places.has_one(Role::kPlayer, 1, limits));
    places.take(Role::kPlayer, 1);
  }
  CHECK_FALSE(places.has_one(Role::kPlayer, 1, limits));
  CHECK(places.has_one(Role::kPlayer, 2, limits));
  places.take(Role::kSpectator, 2);
  CHECK_FALSE(places.has_one(Role::kPlayer, 2, limits));
  CHECK(places.has_one(Role::kPlayer, 3, limits));
}
