#include "server/net/outbox.h"

#include <catch2/catch.hpp>

#include <string>

#include "shared/core/random.h"

namespace woodlouse::server::outbox_test {

using Outcome = FrameSlots::Outcome;

namespace {

Line line(const std::string& text) { return Line(text); }
Frame key(std::uint64_t tick) {
  return {FrameKind::kKey, tick, tick, tick, line("k" + std::to_string(tick))};
}
Frame delta(std::uint64_t tick, std::uint64_t base) {
  return {FrameKind::kDelta, tick, base, tick, line("d" + std::to_string(tick))};
}

std::string text(const Outbox::Batch& batch) {
  std::string all;
  for (const Line& l : batch.lines) all += *l + ' ';
  return all;
}

}  // namespace

TEST_CASE("lines leave in their order, then the map, then the key, then the delta on it") {
  Outbox outbox(1000);
  outbox.offer(key(60));
  outbox.offer(delta(63, 60));
  outbox.push_map(line("map"));
  outbox.push(line("a"));
  outbox.push(line("b"));
  const Outbox::Batch batch = outbox.take();
  CHECK(text(batch) == "a b map k60 d63 ");
  CHECK(batch.frames == 2);
  outbox.written();
  CHECK(outbox.take().empty());
}

TEST_CASE("a stale delta is replaced, never queued beside the new one") {
  Outbox outbox(1000);
  CHECK(outbox.offer(delta(63, 60)) == Outcome::kStored);
  CHECK(outbox.offer(delta(66, 60)) == Outcome::kReplaced);
  CHECK(text(outbox.take()) == "d66 ");
}

TEST_CASE("a delta never replaces an unsent key") {
  Outbox outbox(1000);
  outbox.offer(key(60));
  CHECK(outbox.offer(delta(63, 60)) == Outcome::kStored);
  CHECK(outbox.offer(delta(66, 60)) == Outcome::kReplaced);
  CHECK(text(outbox.take()) == "k60 d66 ");
}

TEST_CASE("a new key replaces the unsent key and the delta that rests on it") {
  Outbox outbox(1000);
  outbox.offer(key(60));
  outbox.offer(delta(63, 60));
  CHECK(outbox.offer(key(120)) == Outcome::kReplaced);
  CHECK(text(outbox.take()) == "k120 ");
}

TEST_CASE("a delta older than what was seen is not stored, a key asked for again is") {
  Outbox outbox(1000);
  outbox.offer(key(60));
  outbox.offer(delta(66, 60));
  outbox.take();
  CHECK(outbox.offer(delta(63, 60)) == Outcome::kStale);
  CHECK(outbox.offer(delta(66, 60)) == Outcome::kStale);
  CHECK(outbox.offer(key(60)) == Outcome::kStored);
  CHECK(outbox.offer(delta(69, 60)) == Outcome::kStored);
  CHECK(text(outbox.take()) == "k60 d69 ");
}

TEST_CASE("behind a key that is asked for again comes the newest delta again, and never an older one") {
  Outbox outbox(1000);
  outbox.offer(key(60));
  outbox.offer(delta(66, 60));
  outbox.take();
  outbox.written();
  CHECK(outbox.offer(key(60)) == Outcome::kStored);
  CHECK(outbox.offer(delta(66, 60)) == Outcome::kStored);
  CHECK(text(outbox.take()) == "k60 d66 ");
  outbox.written();
  outbox.offer(delta(69, 60));
  outbox.offer(key(60));
  CHECK(outbox.offer(delta(66, 60)) == Outcome::kStale);
  CHECK(text(outbox.take()) == "k60 d69 ");
}

TEST_CASE("a key older than the newest is not stored, since the deltas to come rest on the newest") {
  Outbox outbox(1000);
  outbox.offer(key(120));
  CHECK(outbox.offer(key(60)) == Outcome::kStale);
  CHECK(text(outbox.take()) == "k120 ");
}

TEST_CASE("a delta always leaves after its key, whatever is offered and taken in between") {
  woodlouse::core::Random random(7);
  Outbox outbox(1000);
  std::uint64_t newest_key = 0, held = 0, last = 0;
  bool any_key = false;
  for (std::uint64_t tick = 0; tick < 20'000; ++tick) {
    if (tick % 20 == 0) {
      outbox.offer(key(tick));
      newest_key = tick;
      any_key = true;
    } else if (any_key) {
      outbox.offer(delta(tick, newest_key));
    }
    if (random.uniform() > 0.1) continue;
    const Outbox::Batch batch = outbox.take();
    REQUIRE(batch.lines.size() <= 2);
    for (const Line& l : batch.lines) {
      const std::uint64_t sent = std::stoull(l->substr(1));
      REQUIRE(sent >= last);
      last = sent;
      if (l->front() == 'k') held = sent;
      // What the client then holds is the key the delta was made against.
      if (l->front() == 'd') REQUIRE(held == sent / 20 * 20);
    }
    outbox.written();
  }
}

TEST_CASE("events past outbox_bytes overflow, counting those in flight, frames and the map do not count") {
  Outbox outbox(10);
  outbox.offer({FrameKind::kKey, 1, 1, 1, line(std::string(100, 'k'))});
  outbox.push_map(line(std::string(100, 'm')));
  CHECK(outbox.push(line("123456")) == Outbox::Push::kQueued);
  CHECK(outbox.push(line("12345")) == Outbox::Push::kOverflow);
  outbox.take();
  CHECK(outbox.bytes() == 6);
  CHECK(outbox.push(line("12345")) == Outbox::Push::kOverflow);
  CHECK(outbox.push(line("1234")) == Outbox::Push::kQueued);
  outbox.written();
  CHECK(outbox.bytes() == 4);
  CHECK(outbox.push(line("123456")) == Outbox::Push::kQueued);
}

TEST_CASE("a second map is refused while the first waits") {
  Outbox outbox(10);
  CHECK(outbox.push_map(line("m")) == Outbox::PushMap::kQueued);
  CHECK(outbox.push_map(line("m")) == Outbox::PushMap::kAlreadyWaiting);
  outbox.take();
  CHECK(outbox.push_map(line("m")) == Outbox::PushMap::kQueued);
}

TEST_CASE("the last line keeps the events before it, drops what is replaceable, and nothing follows") {
  Outbox outbox(10);
  outbox.push(line("event"));
  outbox.offer(key(60));
  outbox.push_map(line("map"));
  outbox.push_last(line("bye over the limit"), Outbox::Replaceable::kDropped);
  outbox.push(line("late"));
  outbox.offer(delta(63, 60));
  outbox.push_map(line("map"));
  CHECK(text(outbox.take()) == "event bye over the limit ");
  outbox.written();
  CHECK(outbox.take().empty());
}

TEST_CASE("the last line may leave what is replaceable its place before it, and nothing follows either") {
  Outbox outbox(10);
  outbox.offer(key(60));
  outbox.push_map(line("map"));
  outbox.push(line("event"));
  outbox.push_last(line("bye over the limit"), Outbox::Replaceable::kSent);
  CHECK(outbox.offer(delta(63, 60)) == Outcome::kStale);
  outbox.push(line("late"));
  const Outbox::Batch batch = outbox.take();
  CHECK(text(batch) == "event map k60 bye over the limit ");
  CHECK(batch.frames == 1);
  outbox.written();
  outbox.push_map(line("map"));
  CHECK(outbox.take().empty());
}

TEST_CASE(
    "when another game begins, no map and no frame of the one before leaves, and its ticks count anew") {
  Outbox outbox(1000);
  outbox.offer(key(600));
  outbox.offer(delta(603, 600));
  outbox.push_map(line("old map"));
  outbox.push(line("event"));
  outbox.begin_anew();
  outbox.push(line("welcome"));
  CHECK(outbox.push_map(line("map")) == Outbox::PushMap::kQueued);
  CHECK(outbox.offer(key(0)) == Outcome::kStored);
  CHECK(outbox.offer(delta(3, 0)) == Outcome::kStored);
  CHECK(text(outbox.take()) == "event welcome map k0 d3 ");
}

}  // namespace woodlouse::server::outbox_test
