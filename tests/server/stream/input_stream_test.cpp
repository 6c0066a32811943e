#include "server/stream/input_stream.h"

#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/follow/follower.h"
#include "shared/map/map_file.h"
#include "shared/replay/line_writer.h"
#include "shared/replay/writer.h"

namespace woodlouse::server::input_stream_test {
namespace {

using Quiet = InputStream::Quiet;

/// A game in which now and then something is done, streamed as a room does.
struct Stage {
  Stage() {
    auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
    REQUIRE(map);
    match = std::make_unique<match::Match>(*map, match::MatchSettings{60, 9});
    for (int k = 0; k < 3; ++k)
      players.push_back(match->join({"louse" + std::to_string(k), state::Role::kBot}));
    step();  // a stream begins behind a step
  }

  const match::StepRecord& step(bool is_steered = true) {
    if (is_steered) {
      const match::PlayerId player = players[random.next() % players.size()];
      match->file({player,
                   ++seq,
                   {state::ThrustKind::kAlongHeading, {0.5, 0.0}},
                   5,
                   match->tick() + random.next() % 20});
    }
    const match::StepRecord& record = match->advance();
    margins.clear();
    for (const match::AppliedInput& input : record.inputs)
      margins.push_back({input.player, input.seq, 1234 - 5000 * (input.seq % 2)});
    stream.step(RecordedStep(record, margins));
    return record;
  }
  [[nodiscard]] std::string header() const {
    std::string text;
    replay::append_header(text, replay::make_header(*match, "test", ""));
    return text;
  }

  std::unique_ptr<match::Match> match;
  std::vector<match::PlayerId> players;
  std::vector<InputMargin> margins;
  std::uint32_t seq = 0;
  core::Random random{4};
  InputStream stream;
};

/// All lines, to who re-runs them.
void follow(follow::Follower& follower, const std::string& text) {
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = text.find('\n', at);
    REQUIRE(end != std::string::npos);
    INFO(text.substr(at, std::min<std::size_t>(end - at, 200)));
    REQUIRE(follower.take(std::string_view(text).substr(at, end - at)));
  }
}

}  // namespace

TEST_CASE("a stream's lines are those that a recording has, its keyframe apart, and can be re-run") {
  Stage stage;
  static_cast<void>(stage.stream.take(Quiet::kTold));
  stage.stream.keyframe(stage.match->state(), 60);
  std::string streamed = stage.header() + *stage.stream.newest().at(0).lines, recorded;
  replay::ReplayWriter writer;
  match::MatchState first = stage.match->state();
  first.waiting.clear();
  writer.append_header(recorded, replay::make_header(*stage.match, "test", ""));
  writer.append_keyframe(recorded, first);
  for (int k = 0; k < 400; ++k) {
    const match::StepRecord& record = stage.step(k < 300 || k % 7 == 0);
    for (const InputMargin& margin : stage.margins)
      writer.note_margin(margin.player, margin.seq, margin.microseconds);
    writer.append_step(recorded, record);
    if (k % 3 != 0) continue;
    if (const auto part = stage.stream.take(Quiet::kHeldBack)) streamed += *part->lines;
  }
  if (const auto part = stage.stream.take(Quiet::kTold)) streamed += *part->lines;
  writer.flush(recorded);
  CHECK(streamed == recorded);
  follow::Follower follower("test");
  follow(follower, streamed);
  CHECK(follower.proven() == 400);
  CHECK(follower.match()->hash() == stage.match->hash());
}

TEST_CASE("a keyframe says nothing of inputs for steps to come") {
  Stage stage;
  stage.match->file(
      {stage.players[0], 77, {state::ThrustKind::kMapVector, {0.25, 0.5}}, 5, stage.match->tick() + 50});
  REQUIRE_FALSE(stage.match->state().waiting.empty());
  static_cast<void>(stage.stream.take(Quiet::kTold));
  stage.stream.keyframe(stage.match->state(), 60);
  const std::string line = *stage.stream.newest().at(0).lines;
  CHECK(line.find(R"("waiting":[])") != std::string::npos);
  CHECK(line.find("[32,64]") == std::string::npos);
}

TEST_CASE("who comes later gets the keyframe that is kept, and every line since, once") {
  Stage stage;
  static_cast<void>(stage.stream.take(Quiet::kTold));
  stage.stream.keyframe(stage.match->state(), 60);
  for (int k = 0; k < 50; ++k) {
    stage.step();
    if (k % 3 == 2) static_cast<void>(stage.stream.take(Quiet::kHeldBack));
  }
  follow::Follower follower("test");
  follow(follower, stage.header());
  for (const StreamPart& part : stage.stream.newest()) follow(follower, *part.lines);
  stage.step();
  const auto next = stage.stream.take(Quiet::kTold);
  REQUIRE(next);
  CHECK(next->first == stage.stream.newest().back().first);
  follow(follower, *next->lines);
  CHECK(follower.match()->hash() == stage.match->hash());
  CHECK(follower.gaps() == 0);
}

TEST_CASE("steps that did nothing are one line, told when asked for or with the next that did something") {
  Stage stage;
  for (int k = 0; k < 3; ++k) stage.match->leave(stage.players[static_cast<std::size_t>(k)]);
  stage.step(false);
  static_cast<void>(stage.stream.take(Quiet::kTold));
  stage.stream.keyframe(stage.match->state(), 60);
  const std::uint64_t first = stage.match->tick();
  for (int k = 0; k < 5; ++k) stage.step(false);
  CHECK_FALSE(stage.stream.take(Quiet::kHeldBack));
  const auto told = stage.stream.take(Quiet::kTold);
  REQUIRE(told);
  CHECK(told->first == first);
  CHECK(told->next == first + 5);
  CHECK(told->lines->starts_with(R"({"step":)" + std::to_string(first) + R"(,"steps":5,)"));
  for (int k = 0; k < 2; ++k) stage.step(false);
  stage.match->join({"new", state::Role::kBot});
  stage.step(false);
  const auto both = stage.stream.take(Quiet::kHeldBack);
  REQUIRE(both);
  CHECK(both->first == first + 5);
  CHECK(both->next == first + 8);
  CHECK(both->lines->find(R"("join":)") != std::string::npos);
}

TEST_CASE("what is not taken before steps that it is not told of is nobody's") {
  Stage stage;
  stage.step();
  const match::StepRecord missed = stage.match->advance();
  stage.step();
  const auto part = stage.stream.take(Quiet::kTold);
  REQUIRE(part);
  CHECK(part->first == missed.tick + 1);
  CHECK(part->next == missed.tick + 2);
}

TEST_CASE("a step's line is made once for all who ask") {
  Stage stage;
  const LiveStep live(stage.step(), stage.margins);
  CHECK(live.shared() == live.shared());
  const SharedStep shared = live.shared();
  CHECK(shared->line().data() == shared->line().data());
  std::string text;
  replay::Margins margins;
  for (const InputMargin& margin : stage.margins)
    margins[{margin.player, margin.seq}] = replay::whole_milliseconds(margin.microseconds);
  replay::append_step(text, live.record(), margins);
  CHECK(shared->line() == text);
}

}  // namespace woodlouse::server::input_stream_test
