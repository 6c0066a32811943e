#include "client/net/server_clock.h"
#include "client/net/tick_rate.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"

using namespace woodlouse::client;

namespace {

woodlouse::core::Time at(double seconds) {
  return woodlouse::core::Time{} + std::chrono::duration_cast<woodlouse::core::Time::duration>(
                                       std::chrono::duration<double>(1000.0 + seconds));
}

}  // namespace

TEST_CASE("on a jittery line the clock runs within a tick of the truth and never back") {
  woodlouse::core::Random random(3);
  ServerClock clock(60);
  double last = 0.0;
  for (int frame = 0; frame < 1200; ++frame) {
    const double sent = frame * 0.05;
    const double delay = 0.02 + 0.03 * random.uniform() * random.uniform();
    clock.observe(static_cast<std::uint64_t>(600 + frame * 3), at(sent + delay));
    const double shown = clock.tick(at(sent + 0.05));
    REQUIRE(shown >= last);
    last = shown;
    if (frame > 200) REQUIRE(shown == Approx(600 + (sent + 0.03) * 60).margin(1.0));
  }
}

TEST_CASE("a server that moved its clock is followed within a second, without a jump back") {
  ServerClock clock(60);
  double last = 0.0;
  for (int frame = 0; frame < 200; ++frame) {
    const double late = frame >= 100 ? 0.2 : 0.0;  // it lost 0.2 s at frame 100
    const double now = frame * 0.05 + late;
    clock.observe(static_cast<std::uint64_t>(frame * 3), at(now));
    const double shown = clock.tick(at(now));
    REQUIRE(shown >= last);
    last = shown;
    if (frame > 190) REQUIRE(shown == Approx(frame * 3.0).margin(1.5));
  }
}

TEST_CASE("one late frame changes nothing") {
  ServerClock clock(60);
  for (int frame = 0; frame < 100; ++frame)
    clock.observe(static_cast<std::uint64_t>(frame * 3), at(frame * 0.05));
  const double before = clock.tick(at(5.0));
  clock.observe(300, at(5.3));
  REQUIRE(clock.tick(at(5.3)) == Approx(before + 18.0).margin(0.5));
}

TEST_CASE("a tick lasts what the rate says however seldom the clock is asked") {
  ServerClock clock(120);
  clock.observe(1000, at(0.0));
  REQUIRE(clock.tick(at(0.0)) == Approx(1000.0));
  REQUIRE(clock.tick(at(2.5)) == Approx(1300.0));
}

TEST_CASE("the server's rate is measured while frames come, and not by what waited for a stopped client") {
  TickRate rate;
  rate.begin(60, 20.0);
  std::uint64_t tick = 0;
  double now = 0.0;
  const auto frames = [&](int count, double apart) {
    for (int i = 0; i < count; ++i) rate.observe(tick += 3, at(now += apart));
  };
  frames(30, 0.05);
  CHECK(rate.hz() == 0.0);  // too short
  frames(60, 0.05);
  CHECK(rate.hz() == Approx(60.0).margin(0.5));
  now += 6.0;           // stopped, and continued:
  frames(120, 0.0001);  // all that had come meanwhile
  frames(100, 0.05);
  CHECK(rate.hz() == Approx(60.0).margin(0.5));
  frames(100, 0.1);  // a server that is late
  CHECK(rate.hz() == Approx(30.0).margin(0.5));
  rate.begin_anew();
  now += 6.0;
  frames(10, 0.05);
  CHECK(rate.hz() == Approx(30.0).margin(0.5));
}
