// Runs that were driven among others are driven again alone, to the same moments; what was altered is not.
#include "shared/match/ghost.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/map/map_text.h"
#include "shared/match/ghost_tracks.h"

using namespace woodlouse;
using namespace woodlouse::match;

namespace {

/// 40 m that wrap, from end to end in waves, and three gates to be driven through eastwards.
std::shared_ptr<const map::Map> waves(std::uint32_t round_s = 600) {
  const std::string text =
      R"({"name":"waves","terrain":{"function":"waves","grid":8,"scale":20},"edges":"wrap",)"
      R"("physics":{"drag":0.05,"friction":0.02,"thrust_max":6},)"
      R"("spawns":[{"position":[-16,1]},{"position":[-18,-2],"heading":90},{"position":[-17,3],"heading":180}],)"
      R"("race":{"laps":2,"podium_s":2,"round_s":)" +
      std::to_string(round_s) +
      R"(,"gates":[{"a":[-15,19],"b":[-15,-19]},{"a":[0,19],"b":[0,-19]},{"a":[15,19],"b":[15,-19]}]}})";
  auto map = map::parse_map(text, "waves", {});
  if (!map) FAIL(map.error().text());
  return *map;
}

/// Pushes east, more or less, now and then with a number or not at all.
state::Thrust some_thrust(core::Random& random) {
  const std::uint64_t choice = random.next() % 10;
  if (choice == 0) return {};
  if (choice < 3) return state::rounded_along_heading(random.uniform()).thrust;
  return state::rounded_map_vector({1.0, random.uniform() - 0.5}).thrust;
}

/// Of six lice that drive for so long [s], and respawn now and then.
std::vector<DrivenRun> driven(const std::shared_ptr<const map::Map>& map, std::uint32_t tick_hz,
                              std::uint64_t seconds, std::uint64_t seed) {
  Match match(map, {tick_hz, seed, state::Mode::kRace});
  GhostTracks tracks(tick_hz);
  core::Random random(seed);
  std::vector<PlayerId> players;
  std::vector<std::uint32_t> seqs(6, 0);
  for (int k = 0; k < 6; ++k) players.push_back(match.join());
  std::vector<DrivenRun> runs;
  while (match.tick() < seconds * tick_hz) {
    for (std::size_t k = 0; k < players.size(); ++k) {
      if (random.next() % tick_hz == 0) {
        const std::uint32_t ticks =
            random.next() % 2 == 0 ? state::kHeld : 1 + static_cast<std::uint32_t>(random.next() % tick_hz);
        for (std::uint64_t twice = random.next() % 2; twice < 2; ++twice)
          match.file({players[k], ++seqs[k], some_thrust(random), ticks, 0});
      }
      const std::uint64_t choice = random.next() % (60 * tick_hz);
      if (choice == 0) match.respawn(players[k]);
      if (choice == 1) match.respawn_at_gate(players[k]);
    }
    for (DrivenRun& run : tracks.take(match.advance())) runs.push_back(run);
  }
  return runs;
}

}  // namespace

TEST_CASE("a run driven among others is driven again alone to the same moments at any rate") {
  const std::uint32_t tick_hz = GENERATE(30u, 60u, 120u);
  const auto map = waves();
  const std::vector<DrivenRun> runs = driven(map, tick_hz, 240, 5);
  INFO(tick_hz);
  CHECK(runs.size() >= 6);
  for (const DrivenRun& run : runs) {
    REQUIRE(run.is_kept);
    CHECK(run.times.time() == run.time);
    CHECK(run.times.gates.size() == 7);
    CHECK(why_not_proven(*map, tick_hz, run.ghost, run.times).empty());
    const Rerun again = rerun(*map, tick_hz, run.ghost);
    CHECK(again.is_whole);
    CHECK(again.times == run.times);
  }
}

TEST_CASE("a ghost with one input altered is refused by gate and tick") {
  const auto map = waves();
  std::size_t told = 0, altered = 0;
  for (const DrivenRun& run : driven(map, 60, 120, 7)) {
    state::Ghost ghost = run.ghost;
    // One that acts: behind it no other of the same step.
    const auto input = std::find_if(ghost.inputs.begin(), ghost.inputs.end(), [&](const auto& one) {
      return one.thrust.kind == state::ThrustKind::kMapVector && &one != &ghost.inputs.back() &&
             (&one)[1].at > one.at;
    });
    if (input == ghost.inputs.end()) continue;
    input->thrust.value.x -= state::kThrustQuantum;
    const std::string why = why_not_proven(*map, 60, ghost, run.times);
    ++altered;
    if (why.find("gate ") == 0 && why.find("tick ") != std::string::npos) ++told;
  }
  CHECK(altered >= 2);
  CHECK(told == altered);
}

TEST_CASE("what no run can be is refused before it is driven") {
  const auto map = waves();
  const std::vector<DrivenRun> runs = driven(map, 60, 60, 5);
  REQUIRE_FALSE(runs.empty());
  const DrivenRun& run = runs[0];
  state::Ghost ghost = run.ghost;
  const auto why = [&] { return why_not_proven(*map, 60, ghost, run.times); };
  CHECK(why().empty());
  ghost.spawn = 3;
  CHECK(why() == "it begins at spawn 3, but the race has only 3, from 0");
  ghost = run.ghost;
  ghost.ticks = 600 * 60 + 1;
  CHECK(why() == "it takes more than 600 s");
  ghost = run.ghost;
  ghost.inputs.insert(ghost.inputs.begin(), {5, {state::ThrustKind::kAlongHeading, {1.5, 0.0}}, 1});
  CHECK(why() == "its input 0 is none that a step of it could have taken");
  ghost.inputs[0] = {5, {state::ThrustKind::kAlongHeading, {0.3, 0.0}}, 1};
  CHECK(why() == "its input 0 is none that a step of it could have taken");
  ghost = run.ghost;
  ghost.inputs.push_back({ghost.ticks, {}, 1});
  CHECK_FALSE(why().empty());
  ghost = run.ghost;
  --ghost.ticks;
  CHECK(why().find("but re-run it is not, until tick ") != std::string::npos);
  ghost.ticks += 2;
  CHECK(why().find("it is done after tick ") == 0);
  RunTimes fewer = run.times;
  fewer.gates.pop_back();
  CHECK(why_not_proven(*map, 60, run.ghost, fewer) == "it tells of 6 gates, but a run leads through 7");
}

TEST_CASE("a start that was driven while nothing counted is known by the first gate of its re-run") {
  const auto map = waves(10);
  std::size_t counted = 0;
  for (const DrivenRun& run : driven(map, 60, 600, 11)) {
    if (!run.is_kept) continue;
    const Rerun again = rerun(*map, 60, run.ghost);
    REQUIRE_FALSE(again.times.gates.empty());
    const bool began_before = again.times.gates[0] < run.counted_from * rules::kMomentsPerTick;
    if (!began_before) ++counted;
    CHECK((departure(*map, run.times, run.ghost, again).empty() || began_before));
  }
  CHECK(counted > 0);
}

TEST_CASE("of who asks for more than a ghost holds nothing is kept, and it is told") {
  const auto map = waves();
  Match match(map, {60, 1, state::Mode::kRace});
  GhostTracks tracks(60);
  const PlayerId player = match.join();
  std::uint32_t seq = 0;
  std::vector<DrivenRun> runs;
  while (match.tick() < 3600 && runs.empty()) {
    for (int k = 0; k < 200; ++k)
      match.file({player,
                  ++seq,
                  {state::ThrustKind::kMapVector, {match.tick() < 110 ? 0.0 : 1.0, 0.0}},
                  state::kHeld,
                  0});
    for (DrivenRun& run : tracks.take(match.advance())) runs.push_back(run);
  }
  REQUIRE(runs.size() == 1);
  CHECK_FALSE(runs[0].is_kept);
  CHECK(runs[0].ghost.inputs.empty());
  CHECK(runs[0].time > 0);
}
