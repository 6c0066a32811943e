// The files beside: that each plays what its name says, so that equal hashes prove something.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "bench/scenario/play.h"
#include "bench/scenario/scenario_reader.h"

using namespace woodlouse;
using namespace woodlouse::scenario;

namespace {

const std::filesystem::path kSource(WOODLOUSE_SOURCE_DIR);

Scenario shipped(const std::string& name) {
  ReadScenario read = read_scenario(kSource / "tests" / "scenarios" / (name + ".json"), {});
  for (const core::Error& error : read.errors) FAIL(error.text());
  return std::move(*read.scenario);
}

physics::StepCounters counters_of(const std::string& name) {
  const Scenario scenario = shipped(name);
  Play play(scenario, physics::best_instruction_set());
  play.advance(scenario.last_tick());
  return play.match().world().counters();
}

}  // namespace

TEST_CASE("every shipped map has a scenario") {
  std::set<std::string> played;
  const auto files = find_scenarios({kSource / "tests" / "scenarios"});
  REQUIRE(files);
  for (const std::filesystem::path& file : *files)
    played.insert(shipped(file.stem().string()).map->definition.name);
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "maps")) {
    if (entry.path().extension() == ".json") CHECK(played.contains(entry.path().stem().string()));
  }
}

TEST_CASE("the scenarios reach the rare branches they are named for") {
  CHECK(counters_of("extreme_speed").capped > 100);
  CHECK(counters_of("kepler_close").capped > 0);
  CHECK(counters_of("map_jumps").flights > 20);
  CHECK(counters_of("extreme_flight").flights > 20);
  CHECK(counters_of("walls").bounces > 100);
  CHECK(counters_of("rest_and_stick").stops > 10);
}

TEST_CASE("the many lice fill whole batches") {
  const Scenario scenario = shipped("many_lice");
  Play play(scenario, physics::best_instruction_set());
  play.advance(200);
  const auto lice = play.match().world().lice();
  const auto moving = std::count_if(lice.begin(), lice.end(),
                                    [](const state::Louse& l) { return l.phase == state::Phase::kMoving; });
  CHECK(moving > 400);
  CHECK(play.match().world().counters().sub_steps < 2 * play.match().world().counters().louse_steps);
}
