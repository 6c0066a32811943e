#include "server/relay/playout.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace woodlouse::server {
namespace {

using std::chrono::milliseconds;

constexpr Time kBegin = Time{} + std::chrono::hours(5);
Time at(int ms) { return kBegin + milliseconds(ms); }

}  // namespace

TEST_CASE("steps that come in parts are due as evenly as they were played, a delay behind") {
  Playout playout(60, milliseconds(150));
  CHECK(playout.due(1'000'000) < kBegin);  // nothing has come: at once
  for (int part = 0; part < 50; ++part)
    playout.came(static_cast<std::uint64_t>(1006 + 6 * part), at(100 * part));
  for (std::uint64_t tick = 1006; tick < 1300; tick += 3) {
    const Duration behind = playout.due(tick) - at(static_cast<int>(1000 * (tick - 1006) / 60));
    CHECK(behind >= milliseconds(149));
    CHECK(behind <= milliseconds(151));
  }
}

TEST_CASE("a part is there before the one before it is used up, though their ways differ") {
  Playout playout(60, milliseconds(150));
  for (int part = 0; part < 100; ++part) {
    const Time now = at(100 * part + (part * 7) % 30);
    if (part > 10)
      CHECK(playout.due(static_cast<std::uint64_t>(6 * part)) >= now);  // the first of those that come now
    playout.came(static_cast<std::uint64_t>(6 * part + 6), now);
  }
}

TEST_CASE("a room that stood still, or whose ways became longer, is shown evenly again") {
  Playout playout(60, milliseconds(150));
  for (int part = 0; part < 20; ++part) playout.came(static_cast<std::uint64_t>(6 * part), at(100 * part));
  playout.came(120, at(9000));
  CHECK(playout.due(120) == at(9000) + milliseconds(150));
  for (int part = 0; part < Playout::kLateParts; ++part)
    playout.came(static_cast<std::uint64_t>(126 + 6 * part), at(9100 + 100 * part + 200));
  CHECK(playout.due(126) == at(9300) + milliseconds(150));
  playout.came(192, at(10100));  // and shorter: at once
  CHECK(playout.due(192) == at(10100) + milliseconds(150));
}

TEST_CASE("an old game's ticks are due where they are") {
  constexpr std::uint64_t kYears = std::uint64_t{1000} * 3600 * 24 * 365 * 30;
  Playout playout(1000, milliseconds(100));
  playout.came(kYears, at(0));
  CHECK(playout.due(kYears + 500) == at(600));
}

TEST_CASE("a tick that no game reaches says nothing") {
  for (const std::uint32_t hz : {1u, 60u, 1000u}) {
    Playout playout(hz, milliseconds(100));
    playout.came(100, at(0));
    const Time due = playout.due(100);
    for (const std::uint64_t tick : {UINT64_MAX, UINT64_MAX - 1, (Playout::kLongestGame + 1) * hz}) {
      playout.came(tick, at(50));
      CHECK(playout.due(tick) < kBegin);
    }
    CHECK(playout.due(100) == due);
    playout.came(Playout::kLongestGame * hz, at(100));  // far, but a game's
    CHECK(playout.due(Playout::kLongestGame * hz) == at(200));
  }
}

}  // namespace woodlouse::server
