// Maps that rooms of a log have in common.
#include <catch2/catch.hpp>

#include <memory>
#include <utility>

#include "server/chosen_games.h"
#include "server/config.h"
#include "server/stream/map_shelf.h"
#include "tests/server/cluster/logged_room.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

TEST_CASE("rooms of one map have it once, and after them nobody has it") {
  Shard shard;
  shard.open("one");
  shard.step(3);
  const auto former = std::move(shard.game);
  const auto tap = std::move(shard.tap);
  shard.open("two", 6);
  shard.step(3);
  shard.cut();
  ShardView view;
  read_all(view, shard);
  const std::weak_ptr<const map::Map> map = followed(view, "one").shared_map();
  CHECK(followed(view, "two").shared_map() == map.lock());
  CHECK(map.lock() != volcano());
  CHECK(followed(view, "one").hash() == former->hash());
  CHECK(followed(view, "two").hash() == shard.game->hash());
  view = ShardView();
  CHECK(map.expired());
}

TEST_CASE("a room that is opened has the map of those that were") {
  MapShelf shelf;
  ServeConfig config;
  const auto opened = [&](const char* name) {
    config.maps = {std::string(WOODLOUSE_SOURCE_DIR) + name};
    auto games = choose_games(config);
    REQUIRE(games);
    share_maps(*games, shelf);
    return std::move(*games);
  };
  const auto first = opened("/maps/crater_loop.json"), second = opened("/maps/crater_loop.json");
  REQUIRE(first.size() == 2);
  REQUIRE(second.size() == 2);
  for (const auto& games : {first, second})
    for (const ChosenGame& game : games) CHECK(game.map == first[0].map);
  CHECK(opened("/maps/hills.json")[0].map != first[0].map);
  CHECK(shelf.size() == 1);  // nobody has hills any more
}

TEST_CASE("a map that is on the shelf is still held to what its header says") {
  MapShelf shelf;
  replay::Header header = replay::make_header(
      match::Match(volcano(), match::MatchSettings{60, 5, state::Mode::kRoam}), "test", "volcano.json");
  const auto first = replay::recorded_map(header, {"the log", nullptr, nullptr}, &shelf);
  REQUIRE(first);
  CHECK(replay::recorded_map(header, {"the log", nullptr, nullptr}, &shelf).value() == *first);
  CHECK(shelf.size() == 1);
  header.map_hash ^= 1;
  CHECK_FALSE(replay::recorded_map(header, {"the log", nullptr, nullptr}, &shelf));
  header.map_hash ^= 1;
  header.map_definition[header.map_definition.size() / 2] = '?';
  CHECK_FALSE(replay::recorded_map(header, {"the log", nullptr, nullptr}, &shelf));
  CHECK(shelf.size() == 1);
}
