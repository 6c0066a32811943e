#include "server/net/rate_limiter.h"

#include <catch2/catch.hpp>

namespace woodlouse::server::rate_limiter_test {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Verdict = RateLimiter::Verdict;

namespace {
const Time kStart{seconds(5)};
}

TEST_CASE("a burst passes, the line after it is refused with the time to wait, and passes after that time") {
  RateLimiter limiter(10, 20, kStart);
  for (int i = 0; i < 20; ++i) REQUIRE(limiter.take(kStart) == Verdict::kPass);
  REQUIRE(limiter.take(kStart) == Verdict::kRefuse);
  CHECK(limiter.wait() == milliseconds(100));
  CHECK(limiter.take(kStart + milliseconds(99)) == Verdict::kRefuse);
  CHECK(limiter.take(kStart + milliseconds(101)) == Verdict::kPass);
}

TEST_CASE("who sends at the declared rate is never refused") {
  RateLimiter limiter(60, 120, kStart);
  for (int i = 0; i < 60 * 60; ++i) REQUIRE(limiter.take(kStart + i * seconds(1) / 60) == Verdict::kPass);
}

TEST_CASE("over any time, no more than the burst and the rate's share pass") {
  RateLimiter limiter(60, 120, kStart);
  int passed = 0;
  for (int ms = 0; ms < 10'000; ++ms)
    if (limiter.take(kStart + milliseconds(ms)) == Verdict::kPass) ++passed;
  CHECK(passed <= 120 + 60 * 10);
  CHECK(passed >= 120 + 60 * 10 - 1);
}

TEST_CASE("a flood at once is one after kPatience bursts of refusals, not before") {
  RateLimiter limiter(60, 100, kStart);
  int lines = 0;
  while (limiter.take(kStart) != Verdict::kFlood) REQUIRE(++lines <= 1000);
  CHECK(lines == 500);
}

TEST_CASE("a sustained flood is told from a client that is a little too eager") {
  const auto lives = [](int lines_per_s) {
    RateLimiter limiter(60, 120, kStart);
    for (int i = 0; i < lines_per_s * 60; ++i)
      if (limiter.take(kStart + i * seconds(1) / lines_per_s) == Verdict::kFlood) return false;
    return true;
  };
  CHECK(lives(60));
  CHECK(lives(85));
  CHECK_FALSE(lives(150));
  CHECK_FALSE(lives(1000));
}

}  // namespace woodlouse::server::rate_limiter_test
