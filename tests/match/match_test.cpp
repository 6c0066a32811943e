#include "shared/match/match.h"

#include <catch2/catch.hpp>
#include <memory>

#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::match;
using state::ThrustKind;

namespace {

std::shared_ptr<const map::Map> volcano() {
  auto map = std::make_shared<map::Map>();
  map->definition.name = "volcano";
  map->definition.spawns = {{{5, 0}, {0, 1}}, {{-5, 0}, {0, -1}}, {{0, 8}, {1, 0}}};
  map->terrain = std::make_shared<const terrain::Terrain>(
      terrain::BicubicSpline(terrain::sample_function(terrain::FunctionName::kVolcano, 20.0, 10)));
  return map;
}

Input push(PlayerId player, std::uint32_t seq, double x, double y, std::uint32_t ticks = state::kHeld) {
  return {player, seq, {ThrustKind::kMapVector, {x, y}}, ticks, 0};
}

/// Three players for 300 ticks with random thrusts, filed in an order that `shuffle` decides.
std::uint64_t played(std::uint64_t shuffle) {
  Match match(volcano(), {60, 42});
  const PlayerId players[] = {match.join(), match.join(), match.join()};
  core::Random thrusts(9);
  core::Random order(shuffle);
  for (std::uint32_t tick = 0; tick < 300; ++tick) {
    std::vector<Input> inputs;
    for (const PlayerId p : players)
      inputs.push_back(push(p, tick + 1, thrusts.uniform() - 0.5, thrusts.uniform() - 0.5));
    for (std::size_t i = inputs.size(); i > 1; --i) std::swap(inputs[i - 1], inputs[order.next() % i]);
    for (const Input& input : inputs) REQUIRE(match.file(input).outcome == Filed::Outcome::kFiled);
    match.advance();
  }
  return match.hash();
}

}  // namespace

TEST_CASE("the order in which inputs arrive within a tick never changes the hash") {
  const std::uint64_t hash = played(0);
  for (std::uint64_t shuffle = 1; shuffle < 20; ++shuffle) REQUIRE(played(shuffle) == hash);
}

TEST_CASE("a match that stands still does in one call what it would step by step") {
  const auto start = [] {
    auto map = std::make_shared<map::Map>(*volcano());
    map->definition.physics.friction = 5.0;
    auto match = std::make_unique<Match>(map, MatchSettings{60, 1});
    CHECK(match->stands_still());
    match->join();
    match->join();
    CHECK_FALSE(match->stands_still());
    while (match->tick() < 300) match->advance();
    REQUIRE(match->stands_still());
    return match;
  };
  const auto stepped = start(), passed = start();
  for (int k = 0; k < 1000; ++k) stepped->advance();
  passed->stand_still(1000);
  for (const auto* match : {stepped.get(), passed.get()}) CHECK(match->tick() == 1300);
  CHECK(passed->hash() == stepped->hash());
  CHECK(passed->link() == stepped->link());
  for (auto* match : {stepped.get(), passed.get()}) {
    REQUIRE(match->file(push(1, 1, 1.0, 0.0)).tick == 1300);
    CHECK_FALSE(match->stands_still());
    match->respawn(2);
    for (int k = 0; k < 50; ++k) match->advance();
  }
  CHECK(passed->hash() == stepped->hash());
}

TEST_CASE("a join takes effect in the next step, at a spawn point, at rest or rolling from it") {
  Match match(volcano(), {60, 1});
  const PlayerId player = match.join();
  CHECK_FALSE(match.contains(player));
  const StepRecord& record = match.advance();
  CHECK(record.tick == 0);
  CHECK(record.roster == std::vector<RosterChange>{{RosterAction::kJoin, player}});
  CHECK(match.contains(player));
  CHECK(match.tick() == 1);
}

TEST_CASE("the last input of a player in a tick wins, and a pulse ends by itself") {
  Match match(volcano(), {60, 1});
  const PlayerId player = match.join();
  match.file(push(player, 1, 1.0, 0.0));
  match.file(push(player, 2, 0.0, 0.5, 3));
  const StepRecord& record = match.advance();
  CHECK(record.inputs.size() == 2);
  CHECK(match.world().find(player)->thrust == core::Vec2{0.0, 0.5});
  CHECK(match.world().find(player)->thrust_ticks == 2);
  match.advance();
  match.advance();
  CHECK(match.world().find(player)->thrust_kind == ThrustKind::kNone);
}

TEST_CASE("an input that moves nothing still shows in the hash") {
  const auto hash = [](bool with_input) {
    Match match(volcano(), {60, 1});
    const PlayerId player = match.join();
    match.advance();
    if (with_input) match.file({player, 1, {ThrustKind::kNone, {}}, state::kHeld, 0});
    return match.advance().hash;
  };
  CHECK(hash(true) != hash(false));
}

TEST_CASE("who joins under which name and role shows in the hash, and what is otherwise the same does not") {
  const auto hash = [](const PlayerLabel& label) {
    Match match(volcano(), {60, 1});
    match.join(label);
    return match.advance().hash;
  };
  const std::uint64_t ada = hash({"ada", state::Role::kPlayer});
  CHECK(hash({"ada", state::Role::kPlayer}) == ada);
  CHECK(hash({"adb", state::Role::kPlayer}) != ada);
  CHECK(hash({"ada", state::Role::kBot}) != ada);
  CHECK(hash({}) != ada);
}

TEST_CASE("a step that applies nothing and changes no byte makes no link, and the next one binds the gap") {
  Match match(volcano(), {60, 1});
  for (int k = 0; k < 5; ++k) CHECK(match.advance().hash == 0);
  CHECK(match.link() == beginning(match.settings()));
  const PlayerId player = match.join({"ada", state::Role::kPlayer});
  match.advance();
  CHECK(match.link().previous == 0);
  CHECK(match.link().tick == 6);
  match.file({player, 1, {ThrustKind::kAlongHeading, {-1.0, 0.0}}, 60, 0});
  for (int k = 0; k < 3600; ++k) match.advance();
  REQUIRE(match.world().find(player)->phase == state::Phase::kResting);
  const std::uint64_t at_rest = match.hash();
  const state::HashLink link = match.link();
  const auto twin = Match::restore(volcano(), match.settings(), match.state());
  REQUIRE(why_not(match.map(), match.settings(), match.state()).empty());
  for (int k = 0; k < 100; ++k) CHECK(match.advance().hash == at_rest);
  CHECK(match.link() == link);
  CHECK(why_not(match.map(), match.settings(), match.state()).empty());
  const auto later = Match::restore(volcano(), match.settings(), match.state());
  // An input that moves nobody is one that was applied.
  for (Match* game : {&match, twin.get(), later.get()})
    game->file({player, 2, {ThrustKind::kNone, {}}, state::kHeld, 0});
  CHECK(match.advance().hash != at_rest);
  CHECK(match.link().previous == at_rest);
  CHECK(match.link().tick == match.tick());
  CHECK(later->advance().hash == match.hash());
  CHECK(twin->advance().hash != match.hash());  // the same, 100 ticks earlier
}

TEST_CASE("the hash of many lice, some at rest, is that of all of them hashed anew at every tick") {
  Match match(volcano(), {60, 3});
  core::StableHasher hasher;
  std::vector<PlayerId> players;
  for (int k = 0; k < 150; ++k) players.push_back(match.join());
  for (std::uint32_t tick = 0; tick < 900; ++tick) {
    if (tick % 200 == 70) match.leave(players[tick % 150]);
    if (tick % 300 == 170) match.join();
    if (tick % 90 == 3) match.file({players[0], tick, {ThrustKind::kAlongHeading, {0.5, 0.0}}, 10, 0});
    match.advance();
    REQUIRE(match.hash() == state::state_hash(hasher, match.link(), match.world().lice()));
  }
  const auto resting =
      std::count_if(match.world().lice().begin(), match.world().lice().end(),
                    [](const state::Louse& louse) { return louse.phase == state::Phase::kResting; });
  CHECK(resting > 64);
}

TEST_CASE("leaving removes the louse, respawning brings it back to a spawn point with its distance") {
  Match match(volcano(), {60, 5});
  const PlayerId player = match.join();
  match.file(push(player, 1, 1.0, 0.0));
  for (int i = 0; i < 120; ++i) match.advance();
  const double distance = match.world().find(player)->distance;
  REQUIRE(distance > 0.0);
  match.respawn(player);
  match.advance();
  CHECK(match.world().find(player)->thrust_kind == ThrustKind::kNone);
  CHECK(match.world().find(player)->distance == Approx(distance).margin(0.01));
  match.leave(player);
  match.respawn(player);
  const StepRecord& record = match.advance();
  CHECK(record.roster == std::vector<RosterChange>{{RosterAction::kLeave, player}});
  CHECK_FALSE(match.contains(player));
  CHECK(match.file(push(player, 9, 1.0, 0.0)).outcome == Filed::Outcome::kNoLouse);
  CHECK(match.join() == player + 1);
}

TEST_CASE("the seed chooses the spawn points") {
  const auto places = [](std::uint64_t seed) {
    Match match(volcano(), {60, seed});
    std::vector<PlayerId> players;
    for (int i = 0; i < 12; ++i) players.push_back(match.join());
    match.advance();
    std::vector<double> x;
    for (const PlayerId p : players) x.push_back(match.world().find(p)->position.x);
    return x;
  };
  CHECK(places(1) == places(1));
  CHECK(places(1) != places(2));
}
