#include "server/watchers/record_pattern.h"

#include <unistd.h>
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

constexpr std::int64_t kTime = 1'798'761'599;  // 2026-12-31 23:59:59

RecordPattern pattern(const std::string& text, std::size_t rooms = 1) {
  const auto parsed = RecordPattern::parse(text, rooms);
  if (!parsed) FAIL(parsed.error().text());
  return *parsed;
}

std::string named(const std::string& text, std::size_t rooms = 1, const std::string& room = "hills") {
  return pattern(text, rooms).file(room, kTime).string();
}

}  // namespace

TEST_CASE("a recording is called as its pattern says, packed unless it says otherwise") {
  CHECK(named("game.ndjson") == "game.ndjson");
  CHECK(named("game.ndjson.zst") == "game.ndjson.zst");
  CHECK(named("game.zst") == "game.zst");
  CHECK(named("game") == "game.ndjson.zst");
  CHECK(named("a/game.txt") == "a/game.txt.ndjson.zst");
  CHECK(named("{room}") == "hills.ndjson.zst");
  CHECK(named("x-{room}-%Y%m%dT%H%M%SZ.ndjson") == "x-hills-20261231T235959Z.ndjson");
  CHECK(named("%F.%y.%j.%G.%V.%u.%%.ndjson") == "2026-12-31.26.365.2026.53.4.%.ndjson");
  CHECK(named("100%%/game") == "100%/game.ndjson.zst");
  CHECK(named("no/such/folder/") == "no/such/folder/hills-20261231T235959Z.ndjson.zst");
  CHECK(named("{room}", 1, "a/b\\c.d e") == "a_b_c_d_e.ndjson.zst");
}

TEST_CASE("of several rooms each has a file, by the pattern or behind its name") {
  CHECK(named("game.ndjson", 2) == "game.hills.ndjson");
  CHECK(named("game.ndjson.zst", 2) == "game.hills.ndjson.zst");
  CHECK(named("game.zst", 2) == "game.hills.zst");
  CHECK(named("a.b/game", 2) == "a.b/game.hills.ndjson.zst");
  CHECK(named("%H.%M", 2) == "23.59.hills.ndjson.zst");
  CHECK(named("{room}.ndjson", 2) == "hills.ndjson");
}

TEST_CASE("a folder that is there is one, a device is written as it is") {
  const auto folder =
      std::filesystem::temp_directory_path() / ("woodlouse_pattern_test_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  CHECK(named(folder.string()) == (folder / "hills-20261231T235959Z.ndjson.zst").string());
  CHECK(named("/dev/full") == "/dev/full");
  std::filesystem::remove(folder);
}

TEST_CASE("a pattern that can't name a file is refused with what could") {
  const auto [text, words] = GENERATE(table<std::string, std::string>({
      {"", "names no file"},
      {"game%", "ends in a %"},
      {"game-%T", "%T is no field"},
      {"game-%n", "%n is no field"},
      {"game-%p", "%p is no field"},
      {"game-%-d", "%- is no field"},
      {"{name}", "{room} is the only word in braces"},
      {"{room}-{room}", "stands there once"},
      {"game}", "{room} is the only word in braces"},
      {"%Y/game", "has a field in its folder"},
      {"{room}/game", "has {room} in its folder"},
      {"100%/game", "%% is a percent sign"},
  }));
  const auto refused = RecordPattern::parse(text, 1);
  INFO(text);
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.error().text(), Catch::StartsWith("--record") && Catch::Contains(words));
  CHECK_FALSE(refused.error().hint.empty());
}

TEST_CASE("a pattern knows the names that it can have made, with any room, time and number") {
  const RecordPattern folder = pattern("games/");
  for (const char* const name :
       {"hills-20261231T235959Z.ndjson.zst", "a_b-20260101T000000Z.ndjson.zst",
        "hills-20261231T235959Z.1.ndjson.zst", "a-b-20261231T235959Z.9999.ndjson.zst"})
    CHECK(folder.matches(name));
  for (const char* const name :
       {"-20261231T235959Z.ndjson.zst", "hills-20261231T235959Z.ndjson", "hills-2026123T235959Z.ndjson.zst",
        "hills-20261231T235959Z.ndjson.zst.part", "hills.old-20261231T235959Z.ndjson.zst",
        "hills-20261231T235959Z.0.ndjson.zst", "hills-20261231T235959Z.01.ndjson.zst",
        "hills-20261231T235959Z.10000.ndjson.zst", "hills-20261231T235959Z.ndjson.1.zst",
        "hills-20261231T235959Z.1.2.ndjson.zst", "hills.ndjson.zst", ""})
    CHECK_FALSE(folder.matches(name));
  const RecordPattern plain = pattern("game.ndjson");
  CHECK(plain.matches("game.ndjson"));
  CHECK(plain.matches("game.12.ndjson"));
  CHECK_FALSE(plain.matches("game.hills.ndjson"));
  CHECK(plain.matches("game.race.ndjson"));
  CHECK(plain.file("hills/race", 0).filename() == "game.race.ndjson");
  CHECK(plain.file("hills", 0).filename() == "game.ndjson");
  CHECK_FALSE(plain.matches("game.ndjson.1"));
  CHECK_FALSE(plain.matches("shadow.hills.12.game.ndjson"));
  const RecordPattern rooms = pattern("game.ndjson", 2);
  CHECK(rooms.matches("game.hills.ndjson"));
  CHECK(rooms.matches("game.hills.3.ndjson"));
  CHECK_FALSE(rooms.matches("game.ndjson"));
  CHECK_FALSE(rooms.matches("other.hills.ndjson"));
  CHECK(pattern("%%%Y.ndjson").matches("%2026.ndjson"));
  CHECK_FALSE(pattern("%%%Y.ndjson").matches("52026.ndjson"));
}

TEST_CASE("whatever a pattern names, numbered or not, it knows again") {
  for (const char* const text : {"a", "{room}", "%Y.%m", "x.%j.zst", "{room}.%u.ndjson", "1.2.3", "%%"})
    for (const std::size_t rooms : {std::size_t{1}, std::size_t{2}}) {
      const auto file = pattern(text, rooms).file("the moon", kTime);
      INFO(file);
      CHECK(pattern(text, rooms).matches(file.filename().string()));
    }
}
