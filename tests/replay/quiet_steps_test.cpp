// Steps that did nothing: in one line, read one by one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <sstream>
#include <string>

#include "shared/replay/inspect.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/writer.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

/// Of the first of such lines.
std::string refusal(const std::string& step) {
  std::istringstream in("{\"step\":1," + step + ",\"hash\":\"0000000000000001\"}\n");
  ReplayReader reader(in, "r");
  const auto line = reader.next();
  return line ? "no error" : line.error().text();
}

}  // namespace

TEST_CASE("steps that changed nothing stand in one line and are read one by one") {
  ReplayWriter writer;
  std::string out;
  const auto step = [&](std::uint64_t tick, std::uint64_t hash) {
    match::StepRecord record;
    record.tick = tick;
    record.hash = hash;
    writer.append_step(out, record);
  };
  step(7, 5);
  for (std::uint64_t tick = 8; tick < 20; ++tick) step(tick, 5);
  writer.append_chat(out, 20, 1, "ada", "so quiet");
  step(20, 5);
  step(21, 6);
  for (std::uint64_t tick = 22; tick < 25; ++tick) step(tick, 6);
  writer.flush(out);
  step(25, 6);
  writer.flush(out);
  CHECK(out ==
        "{\"step\":7,\"hash\":\"0000000000000005\"}\n"
        "{\"step\":8,\"steps\":12,\"hash\":\"0000000000000005\"}\n"
        "{\"chat\":20,\"player\":1,\"name\":\"ada\",\"text\":\"so quiet\"}\n"
        "{\"step\":20,\"hash\":\"0000000000000005\"}\n"
        "{\"step\":21,\"hash\":\"0000000000000006\"}\n"
        "{\"step\":22,\"steps\":3,\"hash\":\"0000000000000006\"}\n"
        "{\"step\":25,\"hash\":\"0000000000000006\"}\n");
  std::istringstream in(out);
  ReplayReader reader(in, "r");
  std::uint64_t due = 7;
  std::size_t chats = 0;
  for (auto line = reader.next(); line && line->has_value(); line = reader.next()) {
    if (std::holds_alternative<ChatLine>(**line)) ++chats;
    const auto* read = std::get_if<StepLine>(&**line);
    if (read == nullptr) continue;
    CHECK(read->step.tick == due++);
    CHECK(read->steps == 1);
    CHECK(read->step.hash == (read->step.tick < 21 ? 5 : 6));
  }
  CHECK(due == 26);
  CHECK(chats == 1);
}

TEST_CASE(
    "a line of many steps is one of steps that did nothing, and of no more than stand between keyframes") {
  CHECK(refusal("\"steps\":1").find("r:1: steps: ") == 0);
  CHECK(refusal("\"steps\":5001").find("r:1: steps: ") == 0);
  CHECK(refusal("\"steps\":2,\"roster\":[{\"leave\":1}]").find("r:1: steps: ") == 0);
  CHECK(refusal("\"steps\":2,\"inputs\":[[1,1,null]]").find("r:1: steps: ") == 0);
}

TEST_CASE("what belongs to rules of play is refused as such") {
  CHECK(refusal("\"roster\":[{\"respawn\":1,\"at\":\"gate\"}]")
            .find("belongs to rules of play that this build does not know") != std::string::npos);
}

TEST_CASE(
    "a game that stands still is recorded in a few lines, proven tick by tick, and played to any of them") {
  match::Match match(small_map("spline"), {60, 3});
  ReplayWriter writer;
  std::string text;
  writer.append_header(text, make_header(match, "tests", "small.json"));
  writer.append_keyframe(text, match.state());
  match.join({"ada", state::Role::kPlayer});
  for (int tick = 0; tick < 1500; ++tick) {
    writer.append_step(text, match.advance());
    if (match.tick() % 300 == 0) writer.append_keyframe(text, match.state());
  }
  REQUIRE(match.link().tick < 900);
  writer.append_end(text, "test over");
  CHECK(to_text(verdict(text)) == "ok ticks 0 to 1500\n");
  CHECK(static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n')) ==
        match.link().tick + 13);  // header, six keyframes, four stretches at rest, index, end
  const auto playback = opened(text)->play(1234);
  REQUIRE(playback);
  CHECK((*playback)->tick() == 1234);
  CHECK((*playback)->match().hash() == match.hash());
  // Steps that did something are not passed off as such that did not.
  std::string altered = text;
  const std::size_t moving = altered.find("{\"step\":100,");
  const std::size_t end = altered.find("{\"step\":103,");
  REQUIRE(end != std::string::npos);
  altered.replace(moving, end - moving,
                  "{\"step\":100,\"steps\":3," + altered.substr(altered.rfind("\"hash\"", end), 27));
  const Verification found = verdict(altered);
  REQUIRE(found.difference);
  CHECK(found.difference->tick == 101);
}

TEST_CASE("a pause stands where no tick passed, moves nothing, and is told") {
  match::Match match(small_map("spline"), {60, 3});
  ReplayWriter writer;
  std::string text;
  writer.append_header(text, make_header(match, "tests", "small.json"));
  writer.append_keyframe(text, match.state());
  for (int tick = 0; tick < 40; ++tick) {
    if (tick == 20) writer.append_pause(text, {match.tick(), 1000, 4600});
    if (tick == 30) writer.append_pause(text, {match.tick(), 9000, 8000});  // a clock that was set back
    writer.append_step(text, match.advance());
  }
  writer.append_end(text, "test over");
  CHECK(text.find("{\"pause\":20,\"from\":1000,\"until\":4600}\n{\"step\":20,\"steps\":10,") !=
        std::string::npos);
  CHECK(to_text(verdict(text)) == "ok ticks 0 to 40\n");
  const auto summary = inspect_summary(*opened(text));
  REQUIRE(summary);
  CHECK(summary->find("pauses   2, in which nobody was there, 3600 s in all\n") != std::string::npos);
  std::string misplaced = text;
  misplaced.replace(misplaced.find("{\"pause\":20"), 11, "{\"pause\":19");
  const auto refused = verify_text(misplaced);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().text().find("pause: of step 19 stands where step 20 is due") != std::string::npos);
}

TEST_CASE("a line of many steps is no way past the keyframe that is due") {
  match::Match match(small_map("spline"), {60, 3});
  std::string text;
  append_header(text, make_header(match, "tests", "small.json"));
  append_keyframe(text, match.state());
  for (std::uint64_t first = 0; first < 10000; first += 5000) append_quiet_steps(text, first, 5000, 0);
  const auto verification = verify_text(text);
  REQUIRE_FALSE(verification);
  CHECK(verification.error().text().find("r.jsonl:4: more than 5000 steps after the last keyframe") == 0);
}

}  // namespace woodlouse::replay
