#include "bench/scenario/scenario_reader.h"

#include "shared/core/joined.h"
#include "tests/scenarios/written_scenario.h"

using namespace woodlouse;
using namespace woodlouse::scenario;
using Catch::Matchers::Contains;
using Kind = Event::Kind;

namespace {

std::vector<Event> events_of(std::string_view script) {
  const WrittenScenario written(
      with(with(kSmall, R"({"at": 2, "player": 1, "thrust": [0.5, 0], "ticks": 5})", script), "\"20\"",
           "\"100\""));
  const ReadScenario read = read_scenario(written.file(), {});
  for (const core::Error& error : read.errors) FAIL(error.text());
  return {read.scenario->events.begin() + 3, read.scenario->events.end()};
}

}  // namespace

TEST_CASE("what is wrong with a scenario is told with its file, line, field and what to do") {
  struct Case {
    std::string_view from, to, where, what;
  };
  const Case cases[] = {
      {"\"seed\": 1,", "\"seed\": 1", ":10", "not JSON"},
      {"\"seed\": 1", "\"sed\": 1", ":9: sed", "is not known (did you mean \"seed\"?)"},
      {"\"seed\": 1", "\"seed\": -1", ":9: seed", "a whole number is wanted"},
      {"\"seed\": 1", "\"tick_hz\": 1001", ":9: tick_hz", "1001 is out of range"},
      {"\"behavior\": 0", "\"behavior\": 1.5", ":3: behavior", "a whole number"},
      {"\"volcano\"", "\"vulcano\"", ":6: terrain.function", "volcano"},
      {"\"position\": [3, 0]", "\"position\": [30, 0]", ":8: spawns[0].position", "lies outside the map"},
      {"\"speed\": 1", "\"sped\": 1", ":8: spawns[0].sped", "speed"},
      {"\"join\": 3", "\"join\": 0", ":11: script[0].join", "out of range"},
      {"\"join\": 3", "\"join\": 3, \"leave\": 1", ":11: script[0]", "does not say one thing"},
      {"\"join\": 3", "\"join\": 3, \"ticks\": 1", ":11: script[0].ticks", "belongs to an input"},
      {"\"at\": 2", "\"at\": 20", ":12: script[1].at", "20 is out of range (0 to 19)"},
      {"\"at\": 2,", "\"at\": 2, \"until\": 4,", ":12: script[1].until", "repeats nothing"},
      {"\"at\": 2,", "", ":12: script[1]", "\"at\" is missing"},
      {"\"player\": 1", "\"player\": 4", ":12: script[1]", "player 4 is not in the match at step 2"},
      {"\"player\": 1", "\"player\": \"one\"", ":12: script[1].player", "names no player"},
      {"[0.5, 0]", "[0.9, 0.9]", ":12: script[1].thrust", "is longer than 1"},
      {"[0.5, 0]", "1.5", ":12: script[1].thrust", "1.5 is out of range"},
      {"[0.5, 0]", "\"full\"", ":12: script[1].thrust", "is no thrust"},
      {"\"10\": null", "\"0\": null", ":14: hashes.0", "is no tick"},
      {"\"10\": null", "\"ten\": null", ":14: hashes.ten", "is no tick"},
      {"\"10\": null", "\"30\": null", ":14: hashes.20", "stands after a later tick"},
      {"\"10\": null", "\"10\": \"12\"", ":14: hashes.10", "is no hash"},
      {"{\"10\": null, \"20\": null}", "{}", ":14: hashes", "at least one tick"},
      {"\"10\": null", "\"20\": null", ":14: hashes.20", "stands twice"},
  };
  for (const Case& c : cases) {
    const WrittenScenario written(with(kSmall, c.from, c.to));
    const ReadScenario read = read_scenario(written.file(), {});
    CAPTURE(c.to);
    REQUIRE_FALSE(read.scenario);
    CHECK_THAT(read.errors.front().where, Catch::Matchers::EndsWith("small.json" + std::string(c.where)));
    CHECK_THAT(read.errors.front().text(), Contains(std::string(c.what)));
  }
}

TEST_CASE(
    "a map that is not there is an error that names the folder, and one of the folder is found by name") {
  const WrittenScenario unknown(with(kSmall, R"({
    "name": "small",
    "terrain": {"function": "volcano", "grid": 4, "scale": 10}
  })",
                                     "\"nowhere\""));
  const std::filesystem::path maps = std::filesystem::path(WOODLOUSE_SOURCE_DIR) / "maps";
  const ReadScenario read = read_scenario(unknown.file(), maps);
  REQUIRE(read.errors.size() == 1);
  CHECK_THAT(read.errors.front().text(), Contains(":4: map: no map \"nowhere\" in " + maps.string()));
  unknown.write("small.json", with(unknown.read("small.json"), "nowhere", "volcano"));
  const ReadScenario found = read_scenario(unknown.file(), maps);
  REQUIRE(found.scenario);
  CHECK(found.scenario->map->definition.name == "volcano");
  REQUIRE(found.scenario->map->definition.spawns.size() == 1);
  CHECK(found.scenario->map->definition.spawns.front().position == core::Vec2{3.0, 0.0});
}

TEST_CASE("a rule is repeated every so many steps up to its last one") {
  const auto events = events_of(R"({"at": 5, "every": 10, "until": 34, "player": [1, 3], "thrust": -0.5})");
  REQUIRE(events.size() == 6);
  CHECK(events[0].step == 5);
  CHECK(events[5].step == 25);
  CHECK(events[5].player == 3);
  CHECK(events[5].thrust == state::Thrust{state::ThrustKind::kAlongHeading, {-0.5, 0.0}});
  CHECK(events[5].ticks == state::kHeld);
}

TEST_CASE("rules that are due too often are refused, be it that they do nothing") {
  std::string rules;
  for (int k = 0; k < 1'100; ++k) rules += R"(, {"at": 1, "every": 1, "leave": "all"})";
  const std::string many =
      with(with(kSmall, "\"ticks\": 5}", core::joined({"\"ticks\": 5}", rules})), "\"20\"", "\"1000\"");
  const WrittenScenario written(with(many, R"({"at": 2, "player": 1)", R"({"at": 0, "player": 1)"));
  const ReadScenario read = read_scenario(written.file(), {});
  REQUIRE_FALSE(read.scenario);
  CHECK_THAT(read.errors.front().text(), Contains("the script's rules are due more than 1000000 times"));
}

TEST_CASE("all means those who are there, and events of one step keep the order of the file") {
  const auto events = events_of(
      R"({"at": 9, "player": "all", "thrust": null}, {"at": 7, "leave": 2}, {"at": 9, "join": 1}, {"at": 9, "respawn": "all"})");
  std::vector<std::pair<Kind, match::PlayerId>> got;
  for (const Event& event : events) got.emplace_back(event.kind, event.player);
  CHECK(got == std::vector<std::pair<Kind, match::PlayerId>>{{Kind::kLeave, 2},
                                                             {Kind::kInput, 1},
                                                             {Kind::kInput, 3},
                                                             {Kind::kJoin, 4},
                                                             {Kind::kRespawn, 1},
                                                             {Kind::kRespawn, 3},
                                                             {Kind::kRespawn, 4}});
}

TEST_CASE("random thrusts are legal, of both kinds, and the same in each reading") {
  constexpr std::string_view kScript = R"({"at": 1, "every": 1, "player": "all", "thrust": "random"})";
  const auto events = events_of(kScript);
  const auto again = events_of(kScript);
  REQUIRE(events.size() == 3 * 99);
  std::size_t along = 0;
  for (std::size_t k = 0; k < events.size(); ++k) {
    CHECK(events[k].thrust == again[k].thrust);
    CHECK(core::dot(events[k].thrust.value, events[k].thrust.value) <= 1.0);
    along += events[k].thrust.kind == state::ThrustKind::kAlongHeading ? 1 : 0;
  }
  CHECK(along > 90);
  CHECK(along < 210);
}
