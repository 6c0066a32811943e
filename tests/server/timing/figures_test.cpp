#include "server/timing/figures.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

#include "shared/core/random.h"

using namespace woodlouse::server;
using std::chrono::hours;
using std::chrono::microseconds;

TEST_CASE("a quantile is never below the true one and at most a thirty-second above it") {
  woodlouse::core::Random random(3);
  DurationHistogram histogram;
  std::vector<std::uint64_t> values;
  for (int i = 0; i < 20'000; ++i) {
    // Over seven decades, so that every octave is met.
    values.push_back(random.next() >> (34 + random.next() % 28));
    histogram.add(microseconds(values.back()));
  }
  std::sort(values.begin(), values.end());
  for (const double q : {0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(q * static_cast<double>(values.size()) + 0.999999) - 1;
    const auto found = std::chrono::duration_cast<microseconds>(histogram.quantile(q)).count();
    CHECK(static_cast<std::uint64_t>(found) >= values[rank]);
    CHECK(static_cast<double>(found) <= static_cast<double>(values[rank]) * (1.0 + 1.0 / 32.0));
  }
  CHECK(histogram.quantile(1.0) == microseconds(values.back()));
  CHECK(histogram.max() == microseconds(values.back()));
  CHECK(histogram.count() == values.size());
}

TEST_CASE("an empty histogram says zero, an absurd value lands in the last bucket") {
  DurationHistogram histogram;
  CHECK(histogram.quantile(0.99) == Duration::zero());
  histogram.add(hours(24 * 365));
  CHECK(histogram.max() == hours(24 * 365));
  CHECK(histogram.quantile(0.5) > hours(1));
}

TEST_CASE("the summary names every figure with its unit") {
  RoomFigures metrics;
  metrics.ticks = 3600;
  metrics.lateness.add(microseconds(250));
  metrics.clock_moves = 2;
  metrics.frames_encoded = 1200;
  const std::string text = summary("volcano", metrics);
  CHECK_THAT(text, Catch::StartsWith("volcano: ticks 3600, lateness p50 0.250 ms p99 0.250 ms max 0.250 ms"));
  CHECK_THAT(text, Catch::EndsWith("clock moves 2, frames encoded 1200"));
  metrics.ground = GroundFigures{40, 412, 409, 372, 1};
  CHECK_THAT(
      summary("alps", metrics),
      Catch::EndsWith("frames encoded 1200, tiles built 412 (409 ahead), thrown out 372, read failures 1"));
  metrics.ground.reset();
  metrics.shadow = ShadowFigures{3600, 0, false};
  CHECK_THAT(summary("volcano", metrics),
             Catch::EndsWith("frames encoded 1200, 3600 ticks shadowed, 0 differences"));
  metrics.shadow = ShadowFigures{812, 1, true};
  CHECK_THAT(summary("volcano", metrics),
             Catch::EndsWith(", 812 ticks shadowed until it was ended, 1 differences"));
}
