#include "client/watch/play_clock.h"

#include <catch2/catch.hpp>

using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

const woodlouse::core::Time kStart{std::chrono::seconds(100)};

/// Frames of 25 ms for so long; the time when they are over.
woodlouse::core::Time run(PlayClock& clock, woodlouse::core::Time from, std::chrono::milliseconds span) {
  for (const woodlouse::core::Time end = from + span; from < end;) clock.update(from += 25ms);
  return from;
}

}  // namespace

TEST_CASE("a recording plays by itself at its own rate and pauses at its end") {
  PlayClock clock(0, 600, 60);
  clock.update(kStart);
  CHECK(clock.tick() == 0);
  const woodlouse::core::Time now = run(clock, kStart, 2s);
  CHECK(clock.tick() == 120);
  CHECK(clock.seconds() == Approx(2.0));
  CHECK(clock.total_seconds() == Approx(10.0));
  run(clock, now, 9s);
  CHECK(clock.tick() == 600);
  CHECK_FALSE(clock.is_playing());
}

TEST_CASE("what is paused stands still, and play at the end begins again") {
  PlayClock clock(100, 160, 60);
  clock.update(kStart);
  clock.toggle();
  woodlouse::core::Time now = run(clock, kStart, 1s);
  CHECK(clock.tick() == 100);
  clock.toggle();
  now = run(clock, now, 500ms);
  CHECK(clock.tick() == 130);
  clock.jump(1.0);
  now = run(clock, now, 100ms);
  CHECK_FALSE(clock.is_playing());
  clock.toggle();
  CHECK(clock.is_playing());
  CHECK(clock.tick() == 100);
}

TEST_CASE("speeds go from a quarter to sixteen times and no further") {
  PlayClock clock(0, 100'000, 60);
  clock.update(kStart);
  for (int i = 0; i < 10; ++i) clock.slower();
  CHECK(clock.speed() == 0.25);
  woodlouse::core::Time now = run(clock, kStart, 2s);
  CHECK(clock.tick() == 30);
  for (int i = 0; i < 10; ++i) clock.faster();
  CHECK(clock.speed() == 16.0);
  run(clock, now, 2s);
  CHECK(clock.tick() == 30 + 16 * 120);
}

TEST_CASE("single ticks pause, skips and jumps do not, and none leaves the recording") {
  PlayClock clock(0, 1000, 60);
  clock.skip(5.0);
  CHECK(clock.tick() == 300);
  CHECK(clock.is_playing());
  clock.skip(-2.5);
  CHECK(clock.tick() == 150);
  clock.jump(0.7);
  CHECK(clock.tick() == 700);
  CHECK(clock.is_playing());
  clock.step(1);
  CHECK(clock.tick() == 701);
  CHECK_FALSE(clock.is_playing());
  clock.step(-2);
  CHECK(clock.tick() == 699);
  clock.skip(-5000.0);
  CHECK(clock.tick() == 0);
  clock.step(-1);
  CHECK(clock.tick() == 0);
  clock.go_to(99'999);
  CHECK(clock.tick() == 1000);
  clock.step(1);
  CHECK(clock.tick() == 1000);
}

TEST_CASE("a tick back after a fraction of a tick was played is the tick before the one shown") {
  PlayClock clock(0, 1000, 60);
  clock.update(kStart);
  clock.update(kStart + 28ms);  // 1.68 ticks
  CHECK(clock.tick() == 1);
  clock.step(-1);
  CHECK(clock.tick() == 0);
}

TEST_CASE("time in which the viewer was stopped does not count") {
  PlayClock clock(0, 100'000, 60);
  clock.update(kStart);
  clock.update(kStart + 60s);
  CHECK(clock.tick() == 15);
}

TEST_CASE("a recording of a single tick is at its end at once") {
  PlayClock clock(7, 7, 60);
  clock.update(kStart);
  clock.toggle();
  clock.update(kStart + 1s);
  CHECK(clock.tick() == 7);
  CHECK_FALSE(clock.is_playing());
  CHECK(clock.total_seconds() == 0.0);
}
