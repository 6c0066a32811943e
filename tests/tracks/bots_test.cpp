#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "server/bots/racer.h"
#include "server/bots/skill.h"
#include "tests/tracks/game.h"

namespace woodlouse::server::bots {
namespace {

/// All inputs of a game of so many seconds.
std::vector<match::AppliedInput> inputs(const std::string& map, state::Mode mode, Skill skill,
                                        std::uint64_t seed, double seconds = 20.0) {
  tests::BotGame game(map, mode, 3, skill, seed);
  std::vector<match::AppliedInput> all;
  game.play(seconds, [&](const match::StepRecord& step) {
    all.insert(all.end(), step.inputs.begin(), step.inputs.end());
    return false;
  });
  return all;
}

}  // namespace

TEST_CASE("no bot acts on less than 150 ms, and the better ones on later frames, oftener and farther ahead") {
  CHECK(ability(Skill::kHard).reaction_s >= 0.15);
  CHECK(ability(Skill::kFair).reaction_s >= 0.25);
  CHECK(ability(Skill::kEasy).reaction_s >= 0.40);
  CHECK(ability(Skill::kHard).horizon_s > ability(Skill::kFair).horizon_s);
  CHECK(ability(Skill::kFair).horizon_s > ability(Skill::kEasy).horizon_s);
  CHECK(ability(Skill::kHard).aim_error < ability(Skill::kFair).aim_error);
  CHECK(ability(Skill::kFair).aim_error < ability(Skill::kEasy).aim_error);
  CHECK(in_crowd(ability(Skill::kHard), 32).horizon_s == ability(Skill::kHard).horizon_s);
  CHECK(in_crowd(ability(Skill::kHard), 1000).horizon_s == 0.8);
  CHECK(in_crowd(ability(Skill::kHard), 1000).reaction_s == ability(Skill::kHard).reaction_s);
  for (const Skill skill : kSkills) CHECK(skill_from_text(to_text(skill)) == skill);
  CHECK_FALSE(skill_from_text("mean"));
}

TEST_CASE("they see frames as a client gets them: twenty a second, none younger than their reaction") {
  const auto map = tests::shipped_map("crater_loop");
  match::Match game(map, {60, 1, state::Mode::kRace});
  game.join({"one", state::Role::kBot});
  Sight sight;
  for (int tick = 0; tick < 200; ++tick) {
    sight.look(game);
    const GameView* seen = sight.before(game.tick(), 9);
    if (game.tick() >= 9) {
      REQUIRE(seen != nullptr);
      CHECK(seen->tick % 3 == 0);
      CHECK(seen->tick + 9 <= game.tick());
      CHECK(seen->tick + 9 + 3 > game.tick());
    } else {
      CHECK(seen == nullptr);
    }
    game.advance();
  }
}

TEST_CASE("what happens after the frame they see changes nothing of what they do") {
  // Two games that are the same until a stranger moves in one of them: for a reaction's time bots act alike.
  const auto play = [](bool moves) {
    tests::BotGame game("orchard", state::Mode::kForage, 2, Skill::kHard);
    const match::PlayerId stranger = game.match.join({"stranger", state::Role::kPlayer});
    std::vector<match::AppliedInput> all;
    std::uint32_t tick = 0;
    game.play(2.0 + 0.15, [&](const match::StepRecord& step) {
      for (const match::AppliedInput& input : step.inputs) {
        if (input.player != stranger) all.push_back(input);
      }
      if (++tick == 120 && moves) game.match.respawn(stranger);
      return false;
    });
    return all;
  };
  CHECK(play(false) == play(true));
}

TEST_CASE("their thrusts are within the wire's range and steps, and each game of a seed is the same") {
  for (const auto& [map, mode] :
       {std::pair("figure_eight", state::Mode::kRace), std::pair("orchard", state::Mode::kForage),
        std::pair("table", state::Mode::kHill)}) {
    INFO(map);
    const auto first = inputs(map, mode, Skill::kFair, 5);
    REQUIRE(first.size() > 200);
    for (const match::AppliedInput& input : first) {
      REQUIRE(input.kind == state::ThrustKind::kMapVector);
      REQUIRE(core::dot(input.thrust, input.thrust) <= 1.0);
      REQUIRE(input.thrust.x * 128.0 == std::nearbyint(input.thrust.x * 128.0));
      REQUIRE(input.thrust.y * 128.0 == std::nearbyint(input.thrust.y * 128.0));
    }
    CHECK(first == inputs(map, mode, Skill::kFair, 5));
    CHECK(first != inputs(map, mode, Skill::kFair, 6));
    CHECK(first != inputs(map, mode, Skill::kHard, 5));
  }
}

TEST_CASE("they have names of their own in every mode") {
  for (const state::Mode mode : {state::Mode::kRace, state::Mode::kForage, state::Mode::kHill}) {
    std::set<std::string> names;
    for (std::uint32_t number = 0; number < 100; ++number) {
      const std::string name = player_name(mode, number);
      CHECK(names.insert(name).second);
      CHECK(name.size() <= 24);
    }
  }
}

TEST_CASE("a racer that comes no further for long goes back to a spawn") {
  // Behind a wall of a slope that no run-up climbs: the far gate can't be reached.
  auto map = map::parse_map(
      R"({"name":"m","terrain":{"spacing":5,"heights":[[0,0,0,0,0,40,80,120],[0,0,0,0,0,40,80,120],[0,0,0,0,0,40,80,120],[0,0,0,0,0,40,80,120]]},
          "race":{"gates":[{"a":[-8,4],"b":[-8,-4]},{"a":[15,4],"b":[15,-4]}],
                  "spawns":[{"position":[-12,0],"heading":0}]}})",
      "m.json", {});
  REQUIRE(map);
  match::Match game(*map, {60, 1, state::Mode::kRace});
  Team team(**map, game.settings(), Skill::kFair, 1);
  std::uint32_t seq = 1;
  team.take(game.join({"bot", state::Role::kBot}), 0, seq);
  std::size_t respawns = 0;
  for (int tick = 0; tick < 60 * 80; ++tick) {
    respawns += team.steer(game).size();
    game.advance();
  }
  CHECK(respawns >= 1);
  CHECK(respawns <= 3);
}

}  // namespace woodlouse::server::bots
