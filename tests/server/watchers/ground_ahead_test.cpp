#include "server/watchers/ground_ahead.h"

#include <spdlog/sinks/null_sink.h>
#include <spdlog/sinks/ostream_sink.h>
#include <boost/asio/io_context.hpp>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>

#include "server/room/room.h"
#include "server/timing/steady_timekeeper.h"
#include "shared/map/map_file.h"
#include "tests/support/big_map_files.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

std::shared_ptr<spdlog::logger> quiet() {
  return std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>());
}

std::shared_ptr<const map::Map> load(const tests::BigMapFiles& files, const std::string& storage) {
  auto map = map::load_map(files.map(",\"storage\":\"" + storage + "\""));
  if (!map) FAIL(map.error().text());
  return *map;
}

terrain::TileStore& tiles_of(const map::Map& map) {
  return std::get<terrain::TiledGround>(map.terrain->surface()).tiles();
}

}  // namespace

TEST_CASE("a map in memory as a whole has nothing to look ahead for") {
  const tests::BigMapFiles files("ahead_whole");
  boost::asio::thread_pool worker(1);
  CHECK(GroundAhead::make("alps", *load(files, "whole"), "hills.flt", worker, quiet()) == nullptr);
}

TEST_CASE("the spawn points' tiles are there before anybody is") {
  const tests::BigMapFiles files("ahead_spawns");
  const auto map = load(files, "tiles");
  boost::asio::thread_pool worker(1);
  const auto ahead = GroundAhead::make("alps", *map, "hills.flt", worker, quiet());
  worker.join();
  const std::size_t live = tiles_of(*map).counters().live;
  CHECK(live >= 4);
  for (const map::SpawnPoint& spawn : map->definition.spawns) {
    static_cast<void>(map->terrain->sample(spawn.position.x, spawn.position.y));
  }
  CHECK(tiles_of(*map).counters().live == live);
  CHECK(ahead->figures().built == ahead->figures().ahead);
}

TEST_CASE("tiles that a louse may reach are built before it gets there, those of resting ones are not") {
  const tests::BigMapFiles files("ahead_way", 1000, 70, tests::BigMapFiles::wave);
  const auto map = load(files, "tiles");
  // A worker of their own for the spawns: what is looked at here is the louse's way.
  boost::asio::thread_pool spawns(1), worker(1);
  const auto first = GroundAhead::make("alps", *map, "hills.flt", spawns, quiet());
  spawns.join();
  const std::size_t before = tiles_of(*map).counters().live;
  const auto ahead = GroundAhead::make("alps", *map, "hills.flt", worker, quiet());
  state::Louse runner;
  runner.id = 1;
  runner.position = {400.0, 0.0};  // far from the spawns, 3 m before a tile's line
  runner.velocity = {3.0, 0.0};
  state::Louse sleeper = runner;
  sleeper.id = 2;
  sleeper.position = {-400.0, 0.0};
  sleeper.phase = state::Phase::kResting;
  std::vector<state::Louse> lice;
  for (std::size_t k = 0; k < GroundAhead::kTurns; ++k) lice.push_back(k == 2 ? runner : sleeper);
  while (ahead->figures().live == before) ahead->look(lice);  // a look is left out while a batch is at work
  worker.join();
  const std::uint64_t built = tiles_of(*map).counters().built;
  static_cast<void>(map->terrain->sample(400.0, 0.0));
  static_cast<void>(map->terrain->sample(412.0, 0.0));
  CHECK(tiles_of(*map).counters().built == built);
  static_cast<void>(map->terrain->sample(-400.0, 0.0));
  CHECK(tiles_of(*map).counters().built == built + 1);
}

TEST_CASE("a room whose map can't be read any more says so once, loudly, counts it and goes on") {
  const tests::BigMapFiles files("ahead_failure");
  const auto map = load(files, "tiles");
  std::filesystem::resize_file(files.file("hills.flt"), 4 * 201 * 10);
  std::ostringstream lines;
  const auto log =
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(lines));
  boost::asio::io_context ticks{1}, io{1};
  boost::asio::thread_pool worker(1);
  RoomSettings settings;
  settings.name = "alps";
  settings.state_hz = 20;
  settings.bots = 3;
  settings.tick_limit = 2500;
  Start start{map, std::make_unique<match::Match>(map, match::MatchSettings{1000, 0}), "hills.flt", {}, {}};
  SteadyTimekeeper timekeeper;
  Watchers watchers;
  watchers.push_back(GroundAhead::make("alps", *map, "hills.flt", worker, log));
  const auto room =
      Room::make(ticks, Lanes(io, 1), settings, std::move(start), std::move(watchers), timekeeper, log);
  room->start([&] { room->stop({}, "done", [&] { ticks.stop(); }); });
  ticks.run_for(std::chrono::seconds(60));
  worker.join();
  CHECK(room->figures()->ticks == 2500);
  REQUIRE(room->figures()->ground);
  CHECK(room->figures()->ground->read_failures > 0);
  const std::string text = lines.str();
  const std::size_t told = text.find("can't be read any more");
  REQUIRE(told != std::string::npos);
  CHECK(text.find("can't be read any more", told + 1) == std::string::npos);
  CHECK(text.find("Check the disk") != std::string::npos);
}
