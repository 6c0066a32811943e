#include "server/stream/stream_queue.h"

#include <catch2/catch.hpp>

#include <optional>
#include <string>
#include <vector>

#include "shared/core/random.h"

namespace woodlouse::server::stream_queue_test {
namespace {

using Kind = StreamPart::Kind;

StreamPart header(const std::string& name) { return {Kind::kHeader, 0, 0, Line("h" + name + "\n")}; }
StreamPart keyframe(std::uint64_t tick) {
  return {Kind::kKeyframe, tick, tick, Line("k" + std::to_string(tick) + "\n")};
}
StreamPart steps(std::uint64_t first, std::uint64_t next) {
  std::string lines;
  for (std::uint64_t step = first; step < next; ++step) lines += std::to_string(step) + "\n";
  return {Kind::kSteps, first, next, Line(std::move(lines))};
}

std::string taken(StreamQueue& queue) {
  std::vector<Line> lines;
  queue.take(lines);
  std::string all;
  for (const Line& line : lines) all += *line;
  return all;
}

}  // namespace

TEST_CASE("steps before a keyframe are nobody's, behind it they come in order, none twice") {
  StreamQueue queue(1000);
  queue.put(header("a"));
  queue.put(steps(3, 6));
  queue.put(keyframe(6));
  queue.put(steps(3, 6));
  queue.put(steps(6, 8));
  queue.put(steps(6, 8));
  queue.put(steps(8, 9));
  CHECK(taken(queue) == "ha\nk6\n6\n7\n8\n");
  queue.put(steps(9, 10));
  CHECK(taken(queue) == "9\n");
  CHECK_FALSE(queue.take_wish());
}

TEST_CASE("who would have too many wait falls behind, asks once, and goes on from the next keyframe") {
  StreamQueue queue(20);
  queue.put(header("a"));
  queue.put(keyframe(100));
  for (std::uint64_t step = 100; step < 105; ++step) queue.put(steps(step, step + 1));
  CHECK_FALSE(queue.take_wish());
  queue.put(steps(105, 106));
  CHECK(queue.bytes() == 0);
  CHECK(queue.take_wish());
  CHECK_FALSE(queue.take_wish());
  queue.put(steps(106, 107));
  CHECK(taken(queue) == "ha\n");  // no game begins without its header
  queue.put(keyframe(107));
  queue.put(steps(107, 108));
  CHECK(taken(queue) == "k107\n107\n");
}

TEST_CASE("a hole in what comes is a gap, too") {
  StreamQueue queue(1000);
  queue.put(keyframe(6));
  queue.put(steps(7, 8));
  CHECK(queue.take_wish());
  CHECK(taken(queue).empty());
}

TEST_CASE("another game's lines begin with its header, whatever waited") {
  StreamQueue queue(1000);
  queue.put(header("a"));
  queue.put(keyframe(6));
  queue.put(steps(6, 8));
  queue.begin_anew();
  queue.put(steps(8, 9));
  queue.put(header("b"));
  queue.put(keyframe(1));
  queue.put(steps(1, 2));
  CHECK(taken(queue) == "hb\nk1\n1\n");
}

TEST_CASE("however parts are taken, doubled, lost and asked for again, what goes out is never broken") {
  core::Random random(11);
  for (int turn = 0; turn < 200; ++turn) {
    StreamQueue queue(40 + random.next() % 200);
    std::uint64_t now = random.next() % 50;
    std::optional<std::uint64_t> due;  // of the client
    std::size_t gaps = 0, wishes = 0;
    queue.put(header("a"));
    queue.put(keyframe(now));
    for (int part = 0; part < 400; ++part) {
      const std::uint64_t next = now + 1 + random.next() % 4;
      const std::uint64_t kind = random.next() % 32;
      if (kind != 0) queue.put(steps(now, next));
      if (kind == 1) queue.put(steps(now, next));
      now = next;
      if (queue.take_wish()) ++wishes, queue.put(keyframe(now));
      REQUIRE(queue.bytes() <= 240);
      if (random.next() % 8 != 0) continue;
      std::vector<Line> lines;
      queue.take(lines);
      for (const Line& line : lines) {
        if (line->starts_with('h')) continue;
        if (line->starts_with('k')) {
          gaps += due.has_value() ? 1 : 0;
          due = std::stoull(line->substr(1));
          continue;
        }
        for (std::size_t at = 0; at < line->size(); at = line->find('\n', at) + 1) {
          REQUIRE(due);
          REQUIRE(std::stoull(line->substr(at)) == *due);
          ++*due;
        }
      }
    }
    CHECK(wishes > 0);
    CHECK(gaps > 0);
  }
}

}  // namespace woodlouse::server::stream_queue_test
