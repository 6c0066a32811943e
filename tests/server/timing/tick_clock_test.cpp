#include "server/timing/tick_clock.h"

#include <catch2/catch.hpp>

using namespace woodlouse::server;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

namespace {
const Time kStart{seconds(1000)};
}

TEST_CASE("the deadline after n ticks is n / tick_hz from the start, whatever the ticks cost") {
  const std::uint32_t hz = GENERATE(1u, 7u, 60u, 1000u);
  TickClock clock(hz, kStart);
  for (std::uint64_t n = 0; n < 10 * hz; ++n) {
    const auto exact = nanoseconds(n * 1'000'000'000u / hz);
    CHECK(clock.deadline() - kStart == exact);
    // Each tick begins late by a varying share of the period: none of it may add up.
    clock.begin(clock.deadline() + clock.period() * static_cast<int>(n % 4) / 2);
  }
  CHECK(clock.deadline() - kStart == seconds(10));
  CHECK(clock.moves() == 0);
}

TEST_CASE("lateness is the time from the deadline to the tick's begin") {
  TickClock clock(50, kStart);
  CHECK(clock.begin(kStart) == Duration::zero());
  CHECK(clock.begin(kStart + milliseconds(23)) == milliseconds(3));
}

TEST_CASE("a clock that is late by five ticks catches up without moving") {
  TickClock clock(50, kStart);
  const Time now = kStart + milliseconds(100);
  for (int n = 0; n < 6; ++n) clock.begin(now);
  CHECK(clock.moves() == 0);
  CHECK(clock.deadline() == kStart + milliseconds(120));
}

TEST_CASE("a clock that is late by more than five ticks moves once and goes on from now") {
  TickClock clock(50, kStart);
  clock.begin(kStart);
  const Time now = kStart + seconds(3);
  CHECK(clock.begin(now) == seconds(3) - milliseconds(20));
  CHECK(clock.moves() == 1);
  CHECK(clock.deadline() == now + milliseconds(20));
  clock.begin(clock.deadline());
  CHECK(clock.moves() == 1);
}

TEST_CASE("half an hour of ticks has not drifted by a nanosecond") {
  TickClock clock(60, kStart);
  // 60 Hz has no period in whole nanoseconds; whole seconds must come out whole all the same.
  for (int second = 0; second < 2000; ++second) {
    for (int n = 0; n < 60; ++n) clock.begin(clock.deadline());
    REQUIRE(clock.deadline() == kStart + seconds(second + 1));
  }
}
