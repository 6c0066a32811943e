#include "shared/match/input_queue.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "shared/core/random.h"

using namespace woodlouse;
using namespace woodlouse::match;
using Outcome = Filed::Outcome;

namespace {

Input input(state::LouseId player, std::uint32_t seq, std::uint64_t wanted = 0) {
  return {player, seq, {state::ThrustKind::kMapVector, {0.5, 0.25}}, state::kHeld, wanted};
}

}  // namespace

TEST_CASE("inputs come out by player and seq, whatever order the players' inputs arrived in") {
  core::Random random(1);
  std::vector<AppliedInput> reference;
  for (int round = 0; round < 50; ++round) {
    // Each player's own inputs keep their order, as a socket keeps it; players are interleaved at random.
    InputQueue queue(120);
    std::uint32_t next[4] = {1, 1, 1, 1};
    for (state::LouseId p = 0; p < 4; ++p) queue.add_player(p);
    for (int left = 40; left > 0;) {
      const auto p = static_cast<state::LouseId>(random.next() % 4);
      if (next[p] > 10) continue;
      REQUIRE(queue.file(input(p, next[p]++, 7), 5).outcome == Outcome::kFiled);
      --left;
    }
    std::vector<AppliedInput> out;
    queue.take(6, out);
    REQUIRE(out.empty());
    queue.take(7, out);
    REQUIRE(out.size() == 40);
    if (round == 0) reference = out;
    REQUIRE(out == reference);
  }
}

TEST_CASE(
    "an input without a tick, or for a past one, is taken by the next step, only the past one is late") {
  InputQueue queue(120);
  queue.add_player(1);
  const Filed now = queue.file(input(1, 1), 10);
  CHECK(now.tick == 10);
  CHECK_FALSE(now.late);
  const Filed past = queue.file(input(1, 2, 9), 10);
  CHECK(past.tick == 10);
  CHECK(past.late);
  CHECK(queue.file(input(1, 3, 130), 10).outcome == Outcome::kFiled);
  CHECK(queue.file(input(1, 4, 131), 10).outcome == Outcome::kTooFar);
}

TEST_CASE("a stale seq, a full queue and a stranger are refused by name, and what was filed stays") {
  InputQueue queue(1000);
  queue.add_player(1);
  CHECK(queue.file(input(2, 1), 10).outcome == Outcome::kNoLouse);
  for (std::uint32_t i = 1; i <= InputQueue::kMaxPending; ++i) {
    REQUIRE(queue.file(input(1, i, 20), 10).outcome == Outcome::kFiled);
  }
  CHECK(queue.file(input(1, 1), 10).outcome == Outcome::kStaleSeq);
  CHECK(queue.file(input(1, 1000), 10).outcome == Outcome::kQueueFull);
  std::vector<AppliedInput> out;
  queue.take(20, out);
  CHECK(out.size() == InputQueue::kMaxPending);
  CHECK(queue.file(input(1, 1000), 10).outcome == Outcome::kFiled);
}

TEST_CASE("who leaves takes his inputs along") {
  InputQueue queue(100);
  queue.add_player(1);
  queue.add_player(2);
  queue.file(input(1, 1), 5);
  queue.file(input(2, 1), 5);
  queue.remove_player(1);
  std::vector<AppliedInput> out;
  queue.take(5, out);
  REQUIRE(out.size() == 1);
  CHECK(out[0].player == 2);
}

TEST_CASE("of a player's inputs for one step so many wait, and a later one takes the last one's place") {
  InputQueue queue(100);
  for (state::LouseId player = 1; player <= 3; ++player) queue.add_player(player);
  for (std::uint32_t seq = 1; seq <= 4; ++seq) {
    CHECK_FALSE(queue.file(input(2, seq, 7), 5, 4).replaced);
    CHECK_FALSE(queue.file(input(1, seq, 7), 5, 4).replaced);
  }
  CHECK(queue.file(input(2, 5, 7), 5, 4).replaced == 4u);
  CHECK(queue.file(input(2, 6, 7), 5, 4).replaced == 5u);
  CHECK_FALSE(queue.file(input(2, 7, 8), 5, 4).replaced);
  std::vector<AppliedInput> out;
  queue.take(7, out);
  REQUIRE(out.size() == 8);
  CHECK(out[3].seq == 4);
  CHECK(out[4].seq == 1);
  CHECK(out[7].seq == 6);
}

TEST_CASE("an input that a keyframe may have told of does not give way") {
  InputQueue queue(100);
  queue.add_player(1);
  for (std::uint32_t seq = 1; seq <= 4; ++seq) queue.file(input(1, seq, 7), 5, 4);
  CHECK(queue.file(input(1, 5, 7), 5, 4).replaced == 4u);
  CHECK(queue.file(input(1, 6, 7), 6, 4).outcome == Outcome::kQueueFull);
  CHECK(queue.players()[0].last_seq == 5u);
  CHECK(queue.file(input(1, 6, 8), 6, 1).outcome == Outcome::kFiled);
  CHECK(queue.file(input(1, 7, 8), 6, 1).replaced == 6u);
}

TEST_CASE("whose thrusts end has one behind each input that waits, and nothing of his or of others goes") {
  InputQueue queue(1000);
  for (state::LouseId player = 1; player <= 3; ++player) queue.add_player(player);
  std::uint32_t seq = 0;
  for (std::uint64_t tick = 10; tick < 200; tick += 7)
    for (state::LouseId player = 1; player <= 3; ++player)
      if ((tick + player) % 3 != 0) queue.file(input(player, ++seq, tick), 5);
  const auto before = queue.waiting();
  const std::uint32_t next = queue.end_thrusts(2, ++seq, {5});
  std::set<std::uint64_t> ticks{5};
  for (const AppliedInput& one : before)
    if (one.player == 2) ticks.insert(one.tick);
  CHECK(next == seq + ticks.size());
  auto after = queue.waiting();
  const auto ends = [&](const AppliedInput& one) {
    return one.player == 2 && one.seq >= seq && one.thrust == core::Vec2{} &&
           one.kind == state::ThrustKind::kAlongHeading && ticks.erase(one.tick) == 1;
  };
  std::erase_if(after, ends);
  CHECK(ticks.empty());
  CHECK(after == before);
  CHECK(queue.end_thrusts(9, 1, {5}) == 2);
  queue.remove_player(2);
  auto others = before;
  std::erase_if(others, [](const AppliedInput& one) { return one.player == 2; });
  CHECK(queue.waiting() == others);
}

TEST_CASE("whose thrusts end again and again has one end a step, not one each time") {
  InputQueue queue(1000);
  queue.add_player(1);
  queue.file(input(1, 1, 8), 5);
  queue.file(input(1, 2, 9), 5);
  std::uint32_t seq = queue.end_thrusts(1, 3, {5});
  CHECK(queue.waiting().size() == 5);
  for (int k = 0; k < 300; ++k) seq = queue.end_thrusts(1, seq, {5});
  CHECK(queue.waiting().size() == 5);
  CHECK(queue.file(input(1, seq, 9), 5).outcome == Outcome::kFiled);
  queue.end_thrusts(1, seq + 1, {});
  CHECK(queue.waiting().size() == 7);
}
