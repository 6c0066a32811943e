#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "server/bots/goal.h"
#include "server/commands/author_time.h"
#include "shared/rules/climb.h"
#include "tests/tracks/game.h"

namespace woodlouse {
namespace {

using server::bots::Skill;

/// The shipped maps that have a mode, by name.
std::vector<std::string> maps_with(state::Mode mode) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(WOODLOUSE_SOURCE_DIR "/maps")) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().stem().string();
    if (tests::shipped_map(name)->definition.modes.has(mode)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("five races, four forages and two hills are shipped, and nothing is wrong with their maps") {
  CHECK(maps_with(state::Mode::kRace) ==
        std::vector<std::string>{"crater_loop", "endless", "figure_eight", "long_jump", "maunga_climb"});
  CHECK(maps_with(state::Mode::kForage).size() == 4);
  const std::vector<std::string> hills = maps_with(state::Mode::kHill);
  CHECK(hills.size() == 2);
  CHECK(std::any_of(hills.begin(), hills.end(), [](const std::string& name) {
    return tests::shipped_map(name)->definition.modes.hill->falls;
  }));
  for (const state::Mode mode : {state::Mode::kRace, state::Mode::kForage, state::Mode::kHill}) {
    for (const std::string& name : maps_with(mode)) {
      INFO(name);
      CHECK(map::check_map(WOODLOUSE_SOURCE_DIR "/maps/" + name + ".json").empty());
    }
  }
}

TEST_CASE("every race has a stretch that full thrust does not climb from rest") {
  for (const std::string& name : maps_with(state::Mode::kRace)) {
    INFO(name);
    CHECK(rules::length_of_run_ups(*tests::shipped_map(name)) >= 1.0);
  }
}

TEST_CASE("every race begins side by side, at rest and 1 to 15 m before a gate of 4 to 12 m") {
  for (const std::string& name : maps_with(state::Mode::kRace)) {
    INFO(name);
    const auto map = tests::shipped_map(name);
    const map::RaceMode& race = *map->definition.modes.race;
    CHECK(race.spawns.size() == 8);
    for (const map::Gate& gate : race.gates) {
      CHECK(server::bots::length(gate.b - gate.a) >= 4.0);
      CHECK(server::bots::length(gate.b - gate.a) <= 12.01);
    }
  }
}

TEST_CASE("one gate of the long jump counts in the air alone") {
  const auto map = tests::shipped_map("long_jump");
  const auto& gates = map->definition.modes.race->gates;
  CHECK(std::count_if(gates.begin(), gates.end(), [](const map::Gate& gate) { return gate.in_air; }) == 1);
}

TEST_CASE("a fair bot drives every race to its end: each gate can be reached") {
  for (const std::string& name : maps_with(state::Mode::kRace)) {
    INFO(name);
    tests::BotGame game(name, state::Mode::kRace, 2, Skill::kFair);
    std::set<std::int64_t> gates;
    const bool finishes = game.play(300.0, [&](const match::StepRecord& step) {
      for (const rules::Event& event : step.events) {
        if (event.kind == rules::EventKind::kGate) gates.insert(event.values[0]);
      }
      return std::any_of(step.events.begin(), step.events.end(),
                         [](const rules::Event& event) { return event.kind == rules::EventKind::kRun; });
    });
    CHECK(finishes);
    CHECK(gates.size() == game.map->definition.modes.race->gates.size());
  }
}

TEST_CASE("the author's time of each race is proved by the ghost that is shipped beside its map") {
  for (const std::string& name : maps_with(state::Mode::kRace)) {
    INFO(name);
    const auto map = tests::shipped_map(name);
    const auto said = server::judge_author_time(*map, WOODLOUSE_SOURCE_DIR "/maps/" + name + ".json");
    if (!said) FAIL_CHECK(said.error().text());
    CHECK(said.value_or("").find("race.author_ms: proved by ghosts/" + name + ".json (") == 0);
    CHECK(map->definition.modes.race->author_ms >= 3 * 15'000);
    CHECK(map->definition.modes.race->author_ms <= 3 * 90'000);
  }
}

TEST_CASE("foragers eat, and kings hold the hill") {
  for (const std::string& name : maps_with(state::Mode::kForage)) {
    INFO(name);
    tests::BotGame game(name, state::Mode::kForage, 2, Skill::kFair);
    game.play(90.0, [](const match::StepRecord&) { return false; });
    for (const rules::TableRow& row : game.match.rules()->table()) CHECK(row.score >= 10);
  }
  for (const std::string& name : maps_with(state::Mode::kHill)) {
    INFO(name);
    tests::BotGame game(name, state::Mode::kHill, 2, Skill::kFair);
    game.play(150.0, [](const match::StepRecord&) { return false; });
    CHECK(game.match.rules()->table().front().score >= 120);
  }
}

}  // namespace woodlouse
