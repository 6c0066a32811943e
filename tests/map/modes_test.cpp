#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "shared/map/map_text.h"
#include "shared/map/modes_reader.h"

using namespace woodlouse;
using namespace woodlouse::map;

namespace {

const std::string kHead =
    R"({"name":"m","terrain":{"spacing":5,"heights":[[0,1,0,1],[0,1,0,1],[0,1,0,1],[0,1,0,2]]},
"spawns":[{"position":[-4,0],"heading":0}])";
const std::string kGates = R"("gates":[{"a":[-2,3],"b":[-2,-3]},{"a":[4,3],"b":[4,-3]}])";

std::shared_ptr<const Map> load(const std::string& modes) {
  auto map = parse_map(kHead + "," + modes + "}", "m.json", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

std::string error_with(const std::string& modes) {
  const auto map = parse_map(kHead + ",\n" + modes + "}", "m.json", {});
  return map ? std::string() : map.error().text();
}

std::string race_error(const std::string& fields) { return error_with("\"race\":{" + fields + "}"); }

}  // namespace

TEST_CASE("a map's modes read back from its canonical text, bit for bit") {
  const auto map =
      load("\"race\":{" + kGates + R"(,"laps":2,"author_ms":41732},"forage":{"crumbs":9},)" +
           R"("hill":{"places":[{"at":[0.1,0]},{"at":[1,1],"radius":2}],"edge":"fall","bump":{"radius":0}})");
  const auto again = parse_canonical_map(map->canonical, "canonical");
  REQUIRE(again.has_value());
  CHECK((*again)->hash == map->hash);
  Modes without = map->definition.modes;
  CHECK(without.race->author_ms == 41732);
  without.race->author_ms = 0;
  CHECK((*again)->definition.modes == without);
  CHECK(without.hill->falls);
  CHECK(without.forage->summits == 4);
  for (const state::Mode mode : state::kModes) CHECK(without.has(mode));
}

TEST_CASE("the time to beat is told to clients, and no part of the map's hash") {
  const auto slow = load("\"race\":{" + kGates + R"(,"author_ms":99000})");
  const auto fast = load("\"race\":{" + kGates + R"(,"author_ms":41732})");
  CHECK(slow->hash == fast->hash);
  CHECK(mode_text(fast->definition.modes, state::Mode::kRace).find("41732") != std::string::npos);
  CHECK(fast->canonical.find("41732") == std::string::npos);
  CHECK(mode_text(fast->definition.modes, state::Mode::kRoam) == "{}");
}

TEST_CASE("a map without modes has the text it had") {
  CHECK(load(R"("edges":"walls")")->canonical.find("race") == std::string::npos);
}

TEST_CASE("what is wrong with a race is told with its line and field") {
  CHECK(race_error("\"laps\":2").find("m.json:3: race") == 0);
  CHECK(race_error("\"laps\":2").find("gates") != std::string::npos);
  CHECK(race_error(R"("gates":[{"a":[-2,3],"b":[-2,-3]}])").find("m.json:3: race.gates: a list of 2 to 32") ==
        0);
  CHECK(race_error(R"("gates":[{"a":[-2,3],"b":[-2,2]},{"a":[4,3],"b":[4,-3]}])")
            .find("race.gates[0]: is shorter") != std::string::npos);
  CHECK(race_error(R"("gates":[{"a":[-2,3],"b":[-2,-3]},{"a":[7.2,3],"b":[4,-3]}])")
            .find("race.gates[1].a: is not") != std::string::npos);
  CHECK(race_error(R"("gates":[{"a":[-2,3],"b":[-2,-3]},{"a":[-4,0],"b":[4,0]}])").find("crosses gate 0") !=
        std::string::npos);
  CHECK(race_error(R"("gates":[{"a":[-2,3],"b":[-2,-3],"air":1},{"a":[4,3],"b":[4,-3]}])")
            .find("air: true or false") != std::string::npos);
  CHECK(race_error(kGates + ",\"laps\":0").find("m.json:3: race.laps") == 0);
  CHECK(
      race_error(kGates + R"(,"spawns":[{"position":[-2.5,0]}])").find("lies 0.5 m before the first gate") !=
      std::string::npos);
  CHECK(race_error(kGates + R"(,"spawns":[{"position":[-4,0],"speed":1}])").find("moves") !=
        std::string::npos);
  CHECK(race_error(kGates + ",\"colour\":1").find("race.colour: is not known") != std::string::npos);
}

TEST_CASE("gates on one line that do not touch do not cross") {
  CHECK(race_error(R"("gates":[{"a":[-2,6],"b":[-2,1]},{"a":[-2,-1],"b":[-2,-6]}])").empty());
  CHECK_FALSE(race_error(R"("gates":[{"a":[-2,6],"b":[-2,1]},{"a":[-2,1],"b":[-2,-6]}])").empty());
}

TEST_CASE("what is wrong with forage and hill is told with its line and field") {
  CHECK(error_with(R"("forage":{"crumbs":65})").find("m.json:3: forage.crumbs") == 0);
  CHECK(error_with(R"("forage":{"crumbs":3,"summits":4})").find("m.json:3: forage.summits") == 0);
  CHECK(error_with(R"("physics":{"gravity":0},"forage":{})").find("there is no gravity") !=
        std::string::npos);
  CHECK(error_with(R"("hill":{})").find("m.json:3: hill") == 0);
  CHECK(error_with(R"("hill":{"places":[]})").find("a list of 1 to 16 places") != std::string::npos);
  CHECK(error_with(R"("hill":{"places":[{"at":[6,0]}]})").find("hill.places[0].at: is not on the map") !=
        std::string::npos);
  CHECK(error_with(R"("hill":{"places":[{"at":[0,0]}],"edge":"cliff"})")
            .find("hill.edge: is none of its choices") != std::string::npos);
  CHECK(error_with(R"("hill":{"places":[{"at":[0,0]}],"bump":{"restitution":2}})")
            .find("hill.bump.restitution") != std::string::npos);
}
