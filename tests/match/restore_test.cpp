// A match restored from its state goes on bit for bit.
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/match/match.h"
#include "shared/state/state_hash.h"

using namespace woodlouse;
using namespace woodlouse::match;

namespace {

std::shared_ptr<const map::Map> map_of(const std::string& more) {
  const auto map = map::parse_map(
      R"({"name":"m","terrain":{"function":"wavy_pot","grid":6,"scale":10})" + more + "}", "m.json", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

/// Joins, leaves, respawns and inputs for now and later, the same for every match that is given the same
/// state of the same generator.
void stir(Match& match, core::Random& random, std::vector<PlayerId>& players,
          std::vector<std::uint32_t>& seqs) {
  const std::uint64_t choice = random.next() % 30;
  if (choice < 2 || players.size() < 4) {
    players.push_back(match.join({"louse " + std::to_string(seqs.size()), state::Role::kBot}));
    seqs.push_back(0);
  } else if (choice == 2) {
    match.leave(players.front());
    players.erase(players.begin());
    seqs.erase(seqs.begin());
  } else if (choice == 3) {
    match.respawn(players.back());
  }
  for (std::size_t k = 0; k < players.size(); ++k) {
    if (random.next() % 5 != 0) continue;
    Input input{players[k], ++seqs[k], {}, state::kHeld, 0};
    const double x = static_cast<double>(random.next() % 129) / 128.0 - 0.5;
    input.thrust = random.next() % 2 == 0 ? state::Thrust{state::ThrustKind::kAlongHeading, {x, 0.0}}
                                          : state::Thrust{state::ThrustKind::kMapVector, {x, -0.5 * x}};
    if (random.next() % 2 == 0) input.ticks = static_cast<std::uint32_t>(1 + random.next() % 40);
    if (random.next() % 3 == 0) input.wanted_tick = match.tick() + random.next() % 120;
    match.file(input);
  }
}

bool is_same(const MatchState& a, const MatchState& b) {
  return a.hash == b.hash && a.link == b.link && a.labels == b.labels && a.next_player == b.next_player &&
         a.players == b.players && a.waiting == b.waiting && a.roster == b.roster;
}

}  // namespace

TEST_CASE("a match restored at any moment, queues full or empty, goes on bit for bit") {
  for (const char* more : {"", R"(,"surface":"function")", R"(,"physics":{"friction":0.6})",
                           R"(,"physics":{"contact":"unilateral","gravity":3})"}) {
    const auto map = map_of(more);
    const MatchSettings settings{60, 11};
    Match match(map, settings);
    core::Random random(5);
    std::vector<PlayerId> players;
    std::vector<std::uint32_t> seqs;
    for (int tick = 0; tick < 400; ++tick) {
      stir(match, random, players, seqs);
      if (tick % 13 == 0) {
        const MatchState state = match.state();
        if (tick > 0) REQUIRE(why_not(*map, settings, state) == "");
        const auto twin = Match::restore(map, settings, state);
        REQUIRE(is_same(twin->state(), state));
        core::Random random_twin = random;
        auto players_twin = players;
        auto seqs_twin = seqs;
        core::Random random_own = random;
        const auto own = Match::restore(map, settings, match.state());
        auto players_own = players;
        auto seqs_own = seqs;
        for (int later = 0; later < 40; ++later) {
          REQUIRE(own->advance().hash == twin->advance().hash);
          REQUIRE(own->link() == twin->link());
          stir(*own, random_own, players_own, seqs_own);
          stir(*twin, random_twin, players_twin, seqs_twin);
        }
        REQUIRE(is_same(own->state(), twin->state()));
      }
      const auto before = Match::restore(map, settings, match.state());
      REQUIRE(before->advance().hash == match.advance().hash);
      REQUIRE(is_same(before->state(), match.state()));
    }
  }
}

TEST_CASE("over a plane nobody can fly") {
  const std::string row = "[0,0,0,0,0]";
  const std::string rows = "[" + row + "," + row + "," + row + "," + row + "," + row + "]";
  const auto map = map::parse_map(R"({"name":"m","terrain":{"origin":[-10,-10],"spacing":5,"heights":)" +
                                      rows + R"(},"physics":{"contact":"unilateral"}})",
                                  "m.json", {});
  REQUIRE(map);
  Match match(*map, {60, 11});
  match.join();
  match.advance();
  MatchState state = match.state();
  REQUIRE(why_not(**map, match.settings(), state) == "");
  state.lice[0].phase = state::Phase::kFlying;
  CHECK(why_not(**map, match.settings(), state) == "louse 1 flies where nobody can");
}

TEST_CASE("whoever flies beyond a wall, by the little that a state may be off, is thrown back by it") {
  const auto map = map_of(R"(,"physics":{"contact":"unilateral"})");
  const terrain::Rectangle domain = map->terrain->domain();
  for (const double beyond : {1e-16, 1e-9, 9e-7}) {
    for (const double climb : {1000.0, 0.0, -3.0}) {
      Match match(map, {60, 11});
      match.join();
      match.advance();
      MatchState state = match.state();
      state::Louse& louse = state.lice[0];
      louse.position = {domain.x_max + beyond * (domain.x_max - domain.x_min), 0.0};
      louse.velocity = {1.0, 0.0};
      louse.phase = state::Phase::kFlying;
      louse.flight_z = map->terrain->sample(domain.x_max, 0.0).z + 1e-9;
      louse.flight_vz = climb;
      core::StableHasher hasher;
      state.hash = state::state_hash(hasher, state.link, state.lice);
      REQUIRE(why_not(*map, match.settings(), state) == "");
      const auto restored = Match::restore(map, match.settings(), state);
      restored->advance();
      const state::Louse& after = restored->world().lice()[0];
      INFO(beyond << ", " << climb << ": " << after.position.x << ", " << after.velocity.x);
      CHECK(after.position.x < domain.x_max);
      CHECK(after.velocity.x < 0.0);
    }
  }
}

TEST_CASE("states that no match can be in are refused by name") {
  const auto map = map_of("");
  const MatchSettings settings{60, 11};
  Match match(map, settings);
  const PlayerId one = match.join();
  match.join();
  match.file({one, 1, {}, state::kHeld, 50});
  for (int k = 0; k < 20; ++k) match.advance();
  const MatchState sound = match.state();
  REQUIRE(why_not(*map, settings, sound) == "");
  const auto fault = [&](const auto& change) {
    MatchState state = sound;
    change(state);
    return why_not(*map, settings, state);
  };
  CHECK(fault([](MatchState& s) { s.lice[0].position.x = 1e9; }) == "louse 1 is not on the map");
  CHECK(fault([](MatchState& s) { s.lice[0].velocity.y = 1e9; }) == "louse 1 is too fast");
  CHECK(fault([](MatchState& s) { s.lice[1].thrust.x = 2.0; }) == "louse 2 has a thrust above 1");
  CHECK(fault([](MatchState& s) { s.lice[1].phase = state::Phase::kFlying; }) ==
        "louse 2 flies where nobody can");
  for (const core::Vec2 heading : {core::Vec2{}, core::Vec2{1e-160, 0.0}, core::Vec2{1.0, 1e-4}})
    CHECK(fault([&](MatchState& s) { s.lice[0].heading = heading; }) == "louse 1 has no heading of length 1");
  CHECK(fault([](MatchState& s) { std::swap(s.lice[0], s.lice[1]); }) == "louse 1 is out of order");
  CHECK(fault([](MatchState& s) { s.next_player = 2; }) == "player 2 is out of order");
  CHECK(fault([](MatchState& s) { s.waiting[0].player = 9; }) ==
        "the waiting input of player 9 seq 1 has no player");
  CHECK(fault([](MatchState& s) { s.waiting[0].tick = 19; }) ==
        "the waiting input of player 1 seq 1 is for tick 19");
  CHECK(fault([](MatchState& s) { s.waiting[0].tick = 141; }) ==
        "the waiting input of player 1 seq 1 is for tick 141");
  CHECK(fault([](MatchState& s) { s.waiting[0].seq = 2; }).find("a seq above the player's last") !=
        std::string::npos);
  CHECK(fault([](MatchState& s) {
          s.roster = {{RosterAction::kLeave, 7}};
        }) == "a change of player 7, who never was");
  for (const auto& change :
       {+[](MatchState& s) { s.link.generator ^= 1; }, +[](MatchState& s) { s.link.previous ^= 1; },
        +[](MatchState& s) { s.hash ^= 1; }, +[](MatchState& s) { s.link.inputs ^= 1; },
        +[](MatchState& s) { s.link.roster ^= 1; }, +[](MatchState& s) { --s.link.tick; },
        +[](MatchState& s) { s.lice[0].distance += 1e-12; }}) {
    CHECK(fault(change).find("its hash is ") == 0);
  }
  CHECK(fault([](MatchState& s) { ++s.link.tick; }) == "its hash is of tick 21, which is later");
  CHECK(fault([](MatchState& s) { s.link.tick = 0; }).find("before the first step that did something") == 0);
  CHECK(fault([](MatchState& s) { s.link.rules = 1; }) ==
        "its rules' state and their hash don't go together");
  const std::string unnamed = "each of its players has one name and is a player or a bot, and nobody else is";
  CHECK(fault([](MatchState& s) { s.labels.erase(2); }) == unnamed);
  CHECK(fault([](MatchState& s) { s.labels[3] = {}; }) == unnamed);
  CHECK(fault([](MatchState& s) { s.labels[2].role = state::Role::kSpectator; }) == unnamed);
}
