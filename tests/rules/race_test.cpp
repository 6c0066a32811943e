#include "shared/rules/race.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_text.h"
#include "shared/match/match.h"

using namespace woodlouse;
using namespace woodlouse::rules;
using match::Match;

namespace {

/// 40 m of level ground without friction that wraps, and two gates to be driven through eastwards.
std::shared_ptr<const map::Map> ring(const std::string& more = R"("laps":2,"round_s":60,"podium_s":5)") {
  std::string heights;
  for (int row = 0; row < 9; ++row) heights += std::string(row ? "," : "") + "[0,0,0,0,0,0,0,0,0]";
  const std::string text = R"({"name":"ring","terrain":{"origin":[0,0],"spacing":[5,5],"heights":[)" +
                           heights +
                           R"(]},"edges":"wrap","physics":{"drag":0,"friction":0,"thrust_max":4},)"
                           R"("spawns":[{"position":[3.5,10],"heading":0}],"race":{"gates":[)"
                           R"({"a":[5,14],"b":[5,6]},{"a":[25,14],"b":[25,6]}],)" +
                           more + "}}";
  auto map = map::parse_map(text, "ring", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

struct Race2 {
  explicit Race2(const std::string& more = R"("laps":2,"round_s":60,"podium_s":5)")
      : match(ring(more), {60, 1, state::Mode::kRace}) {}

  /// Pushes east for a second: to 4 m/s.
  void push(match::PlayerId player, double thrust = 1.0, std::uint32_t ticks = 60) {
    match.file({player, ++seq, {state::ThrustKind::kMapVector, {thrust, 0.0}}, ticks, 0});
  }
  void run(std::uint64_t until) {
    while (match.tick() < until) {
      for (const Event& event : match.advance().events) events.push_back(event);
    }
  }
  [[nodiscard]] std::vector<Event> of(EventKind kind, state::LouseId louse = 1) const {
    std::vector<Event> found;
    std::copy_if(events.begin(), events.end(), std::back_inserter(found),
                 [&](const Event& event) { return event.kind == kind && event.louse == louse; });
    return found;
  }

  Match match;
  std::vector<Event> events;
  std::uint32_t seq = 0;
};

constexpr std::int64_t kSecond = 60 * 65536;

}  // namespace

TEST_CASE("laps and runs are timed to the moment, also across a seam") {
  Race2 race;
  const auto ada = race.match.join({"ada", state::Role::kPlayer});
  race.push(ada);
  race.run(2 + 60 * 45);
  const auto laps = race.of(EventKind::kLap);
  REQUIRE(laps.size() >= 3);
  // After a second it is at 4 m/s for good: 40 m take 10 s. The first lap began while it still gained speed.
  CHECK(std::abs(laps[1].values[1] - 10 * kSecond) <= 2);
  CHECK(laps[0].values[1] > 10 * kSecond);
  CHECK(laps[0].values[2] == 1);
  CHECK(laps[0].values[0] == 0);
  CHECK(laps[1].values[0] == 1);
  const auto runs = race.of(EventKind::kRun);
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].values[0] == laps[0].values[1] + laps[1].values[1]);
  CHECK(runs[0].values[1] == 1);
  CHECK(runs[0].values[2] == 1);  // began at rest on a spawn
  CHECK(runs[1].values[2] == 0);  // a flying start
  const auto gates = race.of(EventKind::kGate);
  REQUIRE(gates.size() >= 5);
  CHECK(gates[0].values == std::array<std::int64_t, 4>{0, 0, 0, kNone});
  CHECK(gates[1].values[0] == 1);
  CHECK(gates[1].values[3] == kNone);
  CHECK(gates[3].values[3] < 0);  // faster than in the best lap so far
  CHECK(std::abs(gates[3].values[2] - 5 * kSecond) <= 2);
  const Standing standing = race.match.rules()->standing(ada);
  CHECK(std::abs(static_cast<std::int64_t>(standing.best_lap) - 10 * kSecond) <= 2);
  CHECK(race.match.rules()->table().front() == TableRow{ada, runs[1].values[0]});
}

TEST_CASE("a race goes from round to round, and nobody's clock runs over the podium") {
  Race2 race;
  race.match.join({"ada", state::Role::kPlayer});
  race.push(1);
  race.run(60 * 140);
  const auto rounds = race.of(EventKind::kRound, 0);
  REQUIRE(rounds.size() >= 4);
  CHECK(rounds[0].values[1] == static_cast<std::int64_t>(Phase::kPlay));
  CHECK(rounds[1].values[1] == static_cast<std::int64_t>(Phase::kPodium));
  CHECK(rounds[2].values[1] == static_cast<std::int64_t>(Phase::kPlay));
  CHECK(rounds[0].values[0] == 1);
  CHECK(rounds[2].values[0] == 2);
  CHECK(rounds[1].moment - rounds[0].moment == 60 * kSecond);
  CHECK(rounds[2].moment - rounds[1].moment == 5 * kSecond);
  for (const Event& lap : race.of(EventKind::kLap)) {
    CHECK_FALSE((lap.moment > rounds[1].moment && lap.moment < rounds[2].moment));
    CHECK(lap.values[1] < 12 * kSecond);
  }
}

TEST_CASE("who respawns loses his run and nothing else, and at a gate it is practice") {
  Race2 race;
  race.match.join({"ada", state::Role::kPlayer});
  race.push(1);
  race.run(60 * 15);
  const Moment best = race.match.rules()->standing(1).best_lap;
  REQUIRE(best > 0);
  race.match.respawn(1);
  race.run(race.match.tick() + 1);
  Standing standing = race.match.rules()->standing(1);
  CHECK(standing.best_lap == best);
  CHECK((standing.gate == 0 && standing.lap == 0 && standing.lap_start == 0));
  race.match.respawn_at_gate(1);  // it has passed none since: a respawn
  race.run(race.match.tick() + 1);
  CHECK(race.match.world().lice()[0].position == core::Vec2{3.5, 10});
  race.push(1);
  race.run(race.match.tick() + 60 * 8);
  CHECK(race.match.rules()->standing(1).gate == 0);  // past gate 1
  const double speed = race.match.world().lice()[0].velocity.x;
  race.match.respawn_at_gate(1);
  race.run(race.match.tick() + 1);
  const state::Louse& louse = race.match.world().lice()[0];
  CHECK(louse.velocity.x == speed);
  CHECK(std::abs(louse.position.x - 25.0) < 0.2);
  const std::size_t runs = race.of(EventKind::kRun).size();
  race.run(race.match.tick() + 60 * 20);
  CHECK(race.of(EventKind::kRun).size() == runs);  // its run was practice
}

TEST_CASE("equal runs rank by who was first, then by id") {
  Race2 race;
  for (const char* name : {"ada", "bob", "eve"}) race.match.join({name, state::Role::kPlayer});
  race.push(1);
  race.push(2);
  race.run(60 * 3);
  race.push(3);
  race.run(60 * 40);
  const auto table = race.match.rules()->table();
  REQUIRE(table.size() == 3);
  CHECK((table[0].louse == 1 && table[1].louse == 2 && table[2].louse == 3));
  CHECK(table[0].score == table[1].score);
}

TEST_CASE("nobody there: the round ends, and the match stands still") {
  Race2 race;
  race.match.join({"ada", state::Role::kPlayer});
  race.run(30);
  CHECK_FALSE(race.match.stands_still());
  CHECK(race.match.rules()->round().phase == Phase::kPlay);
  race.match.leave(1);
  race.run(32);
  CHECK(race.match.rules()->round() == Round{});
  CHECK(race.match.stands_still());
  const std::uint64_t hash = race.match.hash();
  race.match.stand_still(1000);
  race.run(race.match.tick() + 10);
  CHECK(race.match.hash() == hash);
}

TEST_CASE("a race goes on from its state as if nothing had been") {
  Race2 race;
  race.match.join({"ada", state::Role::kPlayer});
  race.match.join({"bob", state::Role::kBot});
  race.push(1);
  for (const std::uint64_t tick : {1u, 2u, 61u, 400u, 1300u, 2500u, 3661u, 3999u}) {
    race.run(tick);
    const match::MatchState state = race.match.state();
    CHECK(match::why_not(race.match.map(), race.match.settings(), state).empty());
    auto copy = Match::restore(ring(), race.match.settings(), state);
    CHECK(copy->state().rules == state.rules);
    for (int k = 0; k < 700; ++k) copy->advance();
    race.run(tick + 1);
    auto again = Match::restore(ring(), race.match.settings(), state);
    CHECK(again->advance().hash == race.match.hash());
  }
}

TEST_CASE("no bytes of a state from outside do more than be refused") {
  Race2 race;
  race.match.join({"ada", state::Role::kPlayer});
  race.match.join({"bob", state::Role::kBot});
  race.push(1);
  race.run(2000);
  const std::string state = race.match.state().rules;
  const auto map = ring();
  const std::vector<state::LouseId> ids{1, 2};
  const auto takes = [&](const std::string& bytes, std::span<const state::LouseId> who) {
    const auto rules = Rules::make(state::Mode::kRace, *map, 60);
    return rules->restore(bytes, who);
  };
  CHECK(takes(state, ids));
  for (std::size_t size = 0; size < state.size(); ++size) CHECK_FALSE(takes(state.substr(0, size), ids));
  CHECK_FALSE(takes(state + '\0', ids));
  CHECK_FALSE(takes(state, std::vector<state::LouseId>{1}));
  CHECK_FALSE(takes(state, std::vector<state::LouseId>{1, 3}));
  CHECK_FALSE(takes(state, std::vector<state::LouseId>{1, 2, 3}));
  core::Random random(5);
  for (int k = 0; k < 20000; ++k) {
    std::string altered = state;
    for (int flips = 0; flips < 3; ++flips)
      altered[random.next() % altered.size()] = static_cast<char>(random.next());
    const auto rules = Rules::make(state::Mode::kRace, *map, 60);
    if (!rules->restore(altered, ids)) continue;
    // What is taken can be played on.
    auto changed = race.match.state();
    changed.rules = altered;
    changed.link.rules = core::stable_hash(altered);
    core::StableHasher hasher;
    changed.hash = state::state_hash(hasher, changed.link, changed.lice);
    REQUIRE(match::why_not(*map, race.match.settings(), changed).empty());
    auto played = Match::restore(map, race.match.settings(), changed);
    for (int tick = 0; tick < 3; ++tick) played->advance();
  }
}
