#include "shared/replay/line_order.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

std::string error_of(const std::vector<std::string>& lines) {
  Recording altered;
  altered.lines = lines;
  const auto verification = verify_text(altered.text());
  const std::string verdict = verification ? to_text(*verification) : verification.error().text();
  // Whoever scans it instead finds the same.
  const auto archive = ReplayArchive::open(
      ReplaySource::of_bytes(altered.text().substr(0, altered.text().size() - 2), "r.jsonl"));
  if (!verification) CHECK(archive.error().text() == verdict);
  return verdict;
}

std::string chat(std::uint64_t tick) {
  return "{\"chat\":" + std::to_string(tick) + ",\"player\":1,\"name\":\"x\",\"text\":\"y\"}\n";
}

Line step_of(std::uint64_t tick) {
  StepLine line;
  line.step.tick = tick;
  return line;
}

Line keyframe_of(std::uint64_t tick) {
  Keyframe keyframe;
  keyframe.state.tick = tick;
  return keyframe;
}

}  // namespace

TEST_CASE("chat stands before the step that was due, and so much of it as a server lets pass") {
  const Recording recording = record({.steps = 130});
  const std::size_t at = recording.line_of_step(100);
  const auto with_chats = [&](std::uint64_t tick, std::size_t count) {
    auto lines = recording.lines;
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), count, chat(tick));
    lines.resize(lines.size() - 2);  // the index, which knows of no such chat, and the end
    return lines;
  };
  const auto place = [&](std::size_t line) { return "r.jsonl:" + std::to_string(at + line) + ": chat: "; };
  const std::size_t own = kMaxChatsAStep;
  CHECK(error_of(with_chats(100, own)).find("ok ticks 0 to 130, then ") == 0);
  CHECK(error_of(with_chats(100, own + 1)) ==
        place(own + 1) + "more than 4096 lines of chat before step 100 (no server lets so many pass)");
  CHECK(error_of(with_chats(99, 1)).find(place(1) + "of step 99 stands where step 100 is due") == 0);
  CHECK(error_of(with_chats(101, 1)).find(place(1) + "of step 101 stands where step 100 is due") == 0);
}

TEST_CASE("what could go on without end is refused: keyframes, an index, steps without a keyframe") {
  const Recording recording = record({.steps = 130});
  const std::size_t keyframe = recording.line_of_step(59) + 1;
  auto lines = recording.lines;
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(keyframe), lines[keyframe]);
  CHECK(error_of(lines).find("a keyframe of tick 60 stands where one of tick 60 stands already") !=
        std::string::npos);
  lines = recording.lines;
  lines.insert(lines.end() - 1, lines[lines.size() - 2]);
  CHECK(error_of(lines).find("stands after the index") != std::string::npos);
  lines = recording.lines;
  std::swap(lines[1], lines[2]);
  CHECK(error_of(lines).find("r.jsonl:2: is no keyframe") == 0);

  LineOrder order;
  order.begin();
  REQUIRE(order.follow(keyframe_of(0)));
  for (std::uint64_t tick = 0; tick < kMaxStepsBetweenKeyframes; ++tick) REQUIRE(order.follow(step_of(tick)));
  CHECK_FALSE(order.follow(step_of(kMaxStepsBetweenKeyframes)));
}

TEST_CASE("a reader that begins in the middle takes the first line as it is") {
  for (const Line& first : {step_of(500), keyframe_of(501), Line(ChatLine{501, 1, "x", "y"})}) {
    LineOrder order;
    REQUIRE(order.follow(first));
    REQUIRE(order.follow(step_of(501)));
    CHECK(order.follow(step_of(501)).error().what == "step 501 stands where step 502 is due");
  }
}

}  // namespace woodlouse::replay
