// Any tick of a recording, found by the index, is the very state the game had.
#include <catch2/catch.hpp>
#include <sstream>

#include "shared/core/random.h"
#include "shared/replay/inspect.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/writer.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

/// Two states but for what waits, which between keyframes is known only of those filed before.
std::string without_waiting(match::MatchState state) {
  state.waiting.clear();
  state.players.clear();
  return state_text(state);
}

ReplayIndex scanned(const std::string& text) {
  std::istringstream in(text);
  const auto index = scan_index(in, "r");
  if (!index) FAIL(index.error().text());
  return *index;
}

}  // namespace

TEST_CASE("the match at any tick is the one that was played, and goes on with the recorded hashes") {
  for (const Recording& recording :
       {record({.seed = 5, .steps = 300}), record_packed({.seed = 5, .steps = 300})}) {
    const auto archive = opened(recording.bytes);
    CHECK(archive->first_tick() == 0);
    CHECK(archive->last_tick() == 300);
    CHECK_FALSE(archive->is_cut_off());
    CHECK(archive->end_reason() == "steps done");
    for (std::uint64_t tick = 1; tick <= 300; tick += 7) {
      const auto playback = archive->play(tick);
      REQUIRE(playback);
      CHECK((*playback)->tick() == tick);
      CHECK(without_waiting((*playback)->match().state()) == without_waiting(recording.states[tick - 1]));
    }
    for (const KeyframePlace& place : archive->index().keyframes) {
      if (place.tick == 0) continue;
      const auto playback = archive->play(place.tick);
      REQUIRE(playback);
      CHECK(state_text((*playback)->match().state()) == state_text(recording.states[place.tick - 1]));
    }
  }
}

TEST_CASE("a playback steps and jumps anywhere, proving every tick") {
  const Recording recording = record_packed({.seed = 6, .steps = 300});
  const auto archive = opened(recording.bytes);
  const auto playback = archive->play(0);
  REQUIRE(playback);
  std::uint64_t steps = 0;
  std::size_t chats = 0;
  for (auto step = (*playback)->advance(); step && *step; step = (*playback)->advance()) {
    CHECK((*step)->is_proven());
    CHECK((*step)->recorded.step.tick == steps++);
    chats += (*step)->chats.size();
  }
  CHECK(steps == 300);
  CHECK(chats > 0);
  core::Random random(1);
  for (int round = 0; round < 60; ++round) {
    const std::uint64_t tick = 1 + random.next() % 300;
    REQUIRE((*playback)->seek(tick));
    CHECK((*playback)->tick() == tick);
    CHECK((*playback)->match().hash() == recording.states[tick - 1].hash);
    if (tick == 300) continue;
    const auto step = (*playback)->advance();
    REQUIRE((step && *step));
    CHECK((*step)->is_proven());
  }
  CHECK_FALSE((*playback)->first_difference());
  CHECK_FALSE((*playback)->seek(301));
  REQUIRE((*playback)->seek(10));
  CHECK(archive->play(301).error().text() == "r.jsonl: has no tick 301 (0 to 300)");
}

TEST_CASE("the index that was written is the one a scan finds, and knows everybody's stay") {
  const Recording recording = record({.seed = 7, .steps = 400});
  std::istringstream in(recording.bytes);
  const auto written = read_index(in, "r");
  REQUIRE(written);
  const ReplayIndex found = scanned(recording.bytes);
  CHECK(found.keyframes == written->keyframes);
  CHECK(found.players == written->players);
  CHECK(found.marks == written->marks);
  CHECK(found.inputs == recording.inputs);
  CHECK(written->inputs == recording.inputs);
  CHECK(found.last_tick == written->last_tick);
  for (const KeyframePlace& place : found.keyframes) {
    CHECK(recording.bytes.compare(place.offset, 12, "{\"keyframe\":") == 0);
  }
  for (std::uint64_t tick = 1; tick <= 400; ++tick) {
    std::vector<state::LouseId> there;
    for (const PlayerSpan& player : found.players) {
      if (player.joined <= tick && (!player.left || tick < *player.left)) there.push_back(player.player);
    }
    std::vector<state::LouseId> lice;
    for (const state::Louse& louse : recording.states[tick - 1].lice) lice.push_back(louse.id);
    REQUIRE(there == lice);
  }
}

TEST_CASE("a recording without an index, with a damaged or with a lying one is read all the same") {
  const Recording recording = record({.seed = 8, .steps = 200});
  const std::string whole = recording.bytes;
  const std::size_t index = whole.rfind("{\"index\":");
  const auto check = [&](const std::string& bytes, bool has_true_index) {
    const auto archive = opened(bytes);
    CHECK(archive->index().keyframes.size() == 4);
    const auto playback = archive->play(150);
    REQUIRE(playback);
    CHECK((*playback)->match().hash() == recording.states[149].hash);
    for (const unsigned jobs : {1u, 3u}) {
      const auto verification = verify(ReplaySource::of_bytes(bytes, "r"), jobs);
      REQUIRE(verification);
      CHECK(verification->ok() == has_true_index);
      CHECK(verification->ticks == 200);
      const std::string said = to_text(*verification);
      CHECK((said.find("differs at tick 200: the index is not that of the lines before it: row 1 of its "
                       "keyframes\nevery tick up to it is the same\n") == 0) == !has_true_index);
    }
  };
  check(whole, true);
  check(whole.substr(0, index), true);
  check(whole.substr(0, index + 20), true);
  std::string lying = whole;
  const std::size_t offset = lying.find(',', lying.find("[[", index)) + 3;
  lying[offset] = lying[offset] == '9' ? '8' : '9';
  check(lying, false);
  std::string damaged = whole;
  damaged[index + 30] = '}';
  const auto archive = ReplayArchive::open(ReplaySource::of_bytes(damaged, "r"));
  REQUIRE_FALSE(archive);
  CHECK(archive.error().text().find("r:") == 0);
}

TEST_CASE("a state is told as JSON, the summary tells who was late") {
  const Recording recording = record({.seed = 9, .steps = 200});
  const auto archive = opened(recording.bytes);
  const auto state = inspect_state(*archive, 120);
  REQUIRE(state);
  CHECK_FALSE(state->difference);
  CHECK(state->json == recording.lines[recording.line_of_step(119) + 1]);
  const auto summary = inspect_summary(*archive);
  REQUIRE(summary);
  CHECK(summary->find("ticks    0 to 200, 3.3 s; ended: steps done") != std::string::npos);
  CHECK(summary->find("inputs   " + std::to_string(recording.inputs) + "\n") != std::string::npos);
  CHECK(summary->find("  louse 1\n") != std::string::npos);
}

}  // namespace woodlouse::replay
