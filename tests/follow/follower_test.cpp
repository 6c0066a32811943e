#include "shared/follow/follower.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "shared/core/random.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::follow {
namespace {

/// The lines of a game from that keyframe on, counted from 1, as a stream has them: without newlines, no
/// keyframe but the first.
std::vector<std::string> stream_of(const replay::Recording& recording, std::size_t keyframe = 1) {
  std::vector<std::string> lines;
  for (const std::string& line : recording.lines) {
    const bool is_keyframe = line.starts_with(R"({"keyframe":)");
    if (is_keyframe && keyframe > 0) --keyframe;
    const bool is_wanted = line.starts_with(R"({"step":)") ? lines.size() >= 2
                           : is_keyframe                   ? lines.size() == 1 && keyframe == 0
                                                           : lines.empty();
    if (is_wanted) lines.push_back(line.substr(0, line.size() - 1));
  }
  return lines;
}

replay::Recording played(std::uint64_t seed = 3) { return replay::record({.seed = seed, .steps = 300}); }

std::size_t take_all(Follower& follower, const std::vector<std::string>& lines) {
  std::size_t taken = 0;
  while (taken < lines.size() && follower.take(lines[taken])) ++taken;
  return taken;
}

}  // namespace

TEST_CASE("a follower's game is the room's at each tick, and each is proven") {
  const replay::Recording recording = played();
  const std::vector<std::string> lines = stream_of(recording);
  Follower follower("the stream");
  CHECK(follower.match() == nullptr);
  for (const std::string& line : lines) {
    REQUIRE(follower.take(line));
    if (const match::Match* match = follower.match(); match != nullptr && match->tick() > 0) {
      const match::MatchState& state = recording.states.at(match->tick() - 1);
      REQUIRE(match->hash() == state.hash);
      REQUIRE(match->state().lice == state.lice);
    }
  }
  CHECK(follower.proven() == 300);
  CHECK(follower.gaps() == 0);
  CHECK_FALSE(follower.difference());
}

TEST_CASE("an altered line is told with its tick, and nothing is shown any more") {
  const std::vector<std::string> lines = stream_of(played());
  core::Random random(17);
  for (int turn = 0; turn < 40; ++turn) {
    std::vector<std::string> altered = lines;
    std::size_t at = 0;
    do at = 3 + random.next() % (lines.size() - 4);
    while (lines[at].find("\"inputs\":[[") == std::string::npos);
    const auto number = replay::find_number(altered[at], "\"inputs\":[[");
    REQUIRE(number.begin != std::string::npos);
    const std::size_t seq = altered[at].find(',', number.begin) + 1;
    altered[at][seq] = altered[at][seq] == '1' ? '2' : '1';  // the seq is hashed, too
    if (altered[at] == lines[at]) continue;
    Follower follower("the stream");
    CHECK(take_all(follower, altered) == at);
    REQUIRE(follower.difference());
    const auto tick = replay::find_number(lines[at], "\"step\":");
    const std::uint64_t step = std::stoull(lines[at].substr(tick.begin, tick.end - tick.begin));
    INFO(follower.difference()->what);
    CHECK((follower.difference()->tick == step || follower.difference()->tick == step + 1));
    CHECK(follower.match() == nullptr);
    CHECK(follower.proven() == step);
    CHECK_FALSE(follower.take(lines[at]));
  }
}

TEST_CASE("a line that is missing, or comes twice, is told") {
  std::vector<std::string> missing = stream_of(played()), twice = missing;
  missing.erase(missing.begin() + 40);
  twice.insert(twice.begin() + 40, twice[40]);
  for (const auto* lines : {&missing, &twice}) {
    Follower follower("the stream");
    CHECK(take_all(follower, *lines) == (lines == &twice ? 41 : 40));
    REQUIRE(follower.difference());
    CHECK(follower.difference()->what.find("where step") != std::string::npos);
  }
}

TEST_CASE("behind a gap it goes on from the new keyframe") {
  const replay::Recording recording = played();
  std::vector<std::string> lines = stream_of(recording);
  const std::vector<std::string> rest = stream_of(recording, 3);
  lines.resize(60);
  lines.insert(lines.end(), rest.begin() + 1, rest.end());
  Follower follower("the stream");
  CHECK(take_all(follower, lines) == lines.size());
  CHECK(follower.gaps() == 1);
  REQUIRE(follower.match() != nullptr);
  CHECK(follower.match()->hash() == recording.states.back().hash);
}

TEST_CASE("a keyframe that was altered is refused, and so is one that is not where the game is") {
  const replay::Recording recording = played();
  std::vector<std::string> lines = stream_of(recording, 3);
  const auto x = replay::find_number(lines[1], R"("lice":[[)");
  REQUIRE(x.begin != std::string::npos);
  lines[1][lines[1].find(",0.", x.begin) + 3] ^= 1;
  Follower follower("the stream");
  CHECK(take_all(follower, lines) == 1);
  REQUIRE(follower.difference());
  CHECK(follower.difference()->tick == recording.states.at(119).tick);

  // Of another game, but of the very tick.
  const std::vector<std::string> own = stream_of(recording), other = stream_of(played(4), 3);
  Follower deceived("the stream");
  std::size_t at = 0;
  while (deceived.match() == nullptr || deceived.match()->tick() < 120) REQUIRE(deceived.take(own[at++]));
  CHECK_FALSE(deceived.take(other[1]));
  CHECK(deceived.difference()->tick == 120);
}

TEST_CASE("a new header begins another game, and lines before their time are told") {
  Follower follower("the stream");
  const auto first = stream_of(played()), second = stream_of(played(4));
  CHECK(take_all(follower, first) == first.size());
  CHECK(take_all(follower, second) == second.size());
  CHECK(follower.proven() == 600);
  CHECK_FALSE(Follower("the stream").take(first[1]));
  Follower without_keyframe("the stream");
  CHECK(without_keyframe.take(first[0]));
  CHECK_FALSE(without_keyframe.take(first[2]));
}

TEST_CASE("whatever comes in the place of a line is told, and none of it does harm") {
  const auto lines = stream_of(played());
  const std::string behavior = R"("behavior":)" + std::to_string(match::kBehavior);
  std::string former = lines[0];
  former.replace(former.find(behavior), behavior.size(), R"("behavior":1)");
  for (const std::string& line :
       {former, std::string(), std::string("{}"), std::string("[1]"), std::string("{\"step\":0}"),
        std::string(R"({"format":"woodlouse-replay"})"), std::string("{\"keyframe\":0}")}) {
    Follower follower("the stream");
    REQUIRE(follower.take(lines[0]));
    REQUIRE(follower.take(lines[1]));
    INFO(line);
    CHECK_FALSE(follower.take(line));
    CHECK_FALSE(follower.difference()->what.empty());
  }
  core::Random random(5);
  for (int turn = 0; turn < 300; ++turn) {
    Follower follower("the stream");
    std::vector<std::string> damaged(lines.begin(), lines.begin() + 20);
    std::string& line = damaged[random.next() % damaged.size()];
    const std::size_t at = random.next() % line.size();
    if (random.next() % 2 == 0)
      line[at] = static_cast<char>(random.next() % 96 + 32);
    else
      line.erase(at, random.next() % 20);
    take_all(follower, damaged);
  }
}

}  // namespace woodlouse::follow
