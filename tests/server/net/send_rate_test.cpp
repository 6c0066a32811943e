#include "server/net/send_rate.h"

#include <catch2/catch.hpp>

#include <functional>
#include <vector>

using namespace woodlouse::server;
using std::chrono::seconds;
using Change = SendRate::Change;
using Pace = SendRate::Pace;

namespace {

const Time kStart{seconds(50)};

struct Seen {
  double second;
  Change change;
  Pace pace;
};

/// 20 frames a second; `replaced(pace, second)` says whether a frame found the one before unsent.
std::vector<Seen> play(double seconds_long, const std::function<bool(Pace, double)>& replaced) {
  SendRate rate(kStart);
  std::vector<Seen> changes;
  for (std::uint64_t index = 0; static_cast<double>(index) < 20.0 * seconds_long; ++index) {
    const FrameKind kind = index % 20 == 0 ? FrameKind::kKey : FrameKind::kDelta;
    if (!rate.wants({kind, 3 * index, 0, index, {}}, 1)) continue;
    const double second = static_cast<double>(index) / 20.0;
    const Time now = kStart + std::chrono::milliseconds(50 * index);
    const Change change = rate.on_frame(now, replaced(rate.pace(), second));
    if (change != Change::kNone) changes.push_back({second, change, rate.pace()});
    if (change == Change::kGiveUp) break;
  }
  return changes;
}

}  // namespace

TEST_CASE("a client that keeps up stays at full rate") {
  CHECK(play(100, [](Pace, double) { return false; }).empty());
}

TEST_CASE("a frame replaced now and then lowers nothing") {
  int n = 0;
  CHECK(play(100, [&n](Pace, double) { return ++n % 5 == 0; }).empty());
}

TEST_CASE("a client that reads nothing goes half rate, keys only, bye within twelve seconds") {
  const auto changes = play(100, [](Pace, double) { return true; });
  REQUIRE(changes.size() == 3);
  CHECK(changes[0].change == Change::kLowered);
  CHECK(changes[0].pace == Pace::kHalf);
  CHECK(changes[1].change == Change::kLowered);
  CHECK(changes[1].pace == Pace::kKeysOnly);
  CHECK(changes[2].change == Change::kGiveUp);
  CHECK(changes[2].second <= 12.0);
}

TEST_CASE("a client that manages half the rate is left there, not ended") {
  for (const Seen& seen : play(200, [](Pace pace, double) { return pace == Pace::kFull; }))
    CHECK(seen.pace != Pace::kKeysOnly);
}

TEST_CASE("after a bad spell the rate is restored step by step") {
  const auto changes = play(120, [](Pace, double second) { return second < 5.0; });
  REQUIRE(changes.size() == 4);
  CHECK(changes[1].pace == Pace::kKeysOnly);
  CHECK(changes[2].change == Change::kRestored);
  CHECK(changes[2].pace == Pace::kHalf);
  CHECK(changes[3].change == Change::kRestored);
  CHECK(changes[3].pace == Pace::kFull);
}

TEST_CASE("a client that fails again after each restoring is tried ever less often") {
  const auto changes = play(600, [](Pace pace, double) { return pace == Pace::kFull; });
  std::vector<double> restored;
  for (const Seen& seen : changes)
    if (seen.change == Change::kRestored) restored.push_back(seen.second);
  REQUIRE(restored.size() >= 4);
  CHECK(restored[3] - restored[2] > 1.5 * (restored[1] - restored[0]));
}

TEST_CASE("half rate is every other of the client's own frames, keys come at every pace") {
  SendRate rate(kStart);
  const auto delta = [](std::uint64_t index) { return Frame{FrameKind::kDelta, 0, 0, index, {}}; };
  CHECK(rate.wants(delta(2), 2));
  CHECK_FALSE(rate.wants(delta(3), 2));
  Time now = kStart;
  while (rate.pace() == Pace::kFull) rate.on_frame(now += seconds(1), true);
  CHECK_FALSE(rate.wants(delta(2), 2));
  CHECK(rate.wants(delta(4), 2));
  while (rate.pace() == Pace::kHalf) rate.on_frame(now += seconds(1), true);
  CHECK_FALSE(rate.wants(delta(4), 2));
  CHECK(rate.wants({FrameKind::kKey, 0, 0, 20, {}}, 2));
}
