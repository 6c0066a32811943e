// However many threads verify, and whatever was altered, they say the same.
#include <catch2/catch.hpp>
#include <sstream>
#include <string>

#include "shared/core/random.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/parallel_verify.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

std::string said(const std::string& text, unsigned jobs) {
  const auto verification = verify(ReplaySource::of_bytes(text, "r.jsonl"), jobs);
  return verification ? to_text(*verification) : verification.error().text();
}

}  // namespace

TEST_CASE("a whole recording verifies with any number of jobs") {
  const Recording recording = record({.steps = 400});
  for (const unsigned jobs : {1u, 2u, 7u, 64u}) CHECK(said(recording.bytes, jobs) == "ok ticks 0 to 400\n");
}

TEST_CASE("an altered byte anywhere gives the same words with one job and with several") {
  const Recording recording = record({.seed = 3, .steps = 200, .keyframe_ticks = 20});
  core::Random random(17);
  for (int round = 0; round < 150; ++round) {
    std::string altered = recording.bytes;
    const std::size_t header = recording.lines.front().size();
    const std::size_t at = header + random.next() % (altered.size() - header);
    altered[at] = static_cast<char>(altered[at] ^ (1 << random.next() % 7));
    INFO(at << " " << altered.substr(at < 40 ? 0 : at - 40, 80));
    CHECK(said(altered, 3) == said(altered, 1));
  }
}

TEST_CASE("a line that is longer than a job's share of memory is read all the same") {
  Recording recording = record({.steps = 130});
  std::string& line = recording.lines[recording.line_of_step(70)];
  line.insert(1, std::string(200'000, ' '));
  const std::string text = recording.text_with_own_index();
  for (const unsigned jobs : {2u, 100u, 256u}) CHECK(said(text, jobs) == "ok ticks 0 to 130\n");
  // Its share is less than that line: the reader that has it says so, and nothing else.
  std::istringstream in(text);
  ReplayReader reader(in, "r.jsonl", 0, 100'000);
  REQUIRE(reader.read_header());
  core::Expected<std::optional<Line>> next = reader.next();
  while (next && *next) next = reader.next();
  CHECK_FALSE(next);
  CHECK(reader.wants_longer_lines());
}

TEST_CASE("lines between two keyframes of the same tick are not passed over") {
  const Recording recording = record({.steps = 130});
  Recording altered = recording;
  const std::size_t keyframe = recording.line_of_step(59) + 1;
  altered.lines.insert(altered.lines.begin() + static_cast<std::ptrdiff_t>(keyframe),
                       recording.lines[keyframe]);
  const std::string one = said(altered.text(), 1);
  CHECK(one.find("a keyframe of tick 60 stands where one of tick 60 stands already") != std::string::npos);
  CHECK(said(altered.text(), 4) == one);
}

}  // namespace woodlouse::replay
