#include "client/play/view_state.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

constexpr std::uint32_t kTickHz = 60;

/// A frame of lice given as rows of wanted_columns().
protocol::Frame frame(std::uint64_t tick, std::vector<std::vector<double>> rows) {
  protocol::Frame result;
  result.tick = result.base = tick;
  result.columns = wanted_columns().size();
  for (const auto& row : rows) result.values.insert(result.values.end(), row.begin(), row.end());
  return result;
}

protocol::Frame delta(std::uint64_t tick, std::uint64_t base, std::vector<std::vector<double>> rows,
                      std::vector<std::uint32_t> gone = {}) {
  protocol::Frame result = frame(tick, std::move(rows));
  result.is_key = false;
  result.base = base;
  result.gone = std::move(gone);
  return result;
}

std::vector<double> row(double id, core::Vec2 at, core::Vec2 v = {}, double distance = 0.0,
                        double flight_z = 0.0) {
  return {id, at.x, at.y, v.x, v.y, 1.0, 0.0, distance, flight_z};
}

}  // namespace

TEST_CASE("a delta changes the lice it names, keeps the others of its key, and drops the gone") {
  ViewState view(kTickHz);
  REQUIRE(view.merge(frame(60, {row(1, {1, 1}), row(2, {2, 2}), row(3, {3, 3})})) ==
          ViewState::Merge::kTaken);
  REQUIRE(view.merge(delta(63, 60, {row(1, {1.5, 1}), row(9, {9, 9})}, {3})) == ViewState::Merge::kTaken);
  const auto& lice = view.newest()->lice;
  REQUIRE(lice.size() == 3);
  REQUIRE(lice.at(1).position == core::Vec2{1.5, 1});
  REQUIRE(lice.at(2).position == core::Vec2{2, 2});
  REQUIRE(lice.contains(9));
}

TEST_CASE("deltas are cumulative against their key: any of them may be lost") {
  ViewState all(kTickHz);
  ViewState some(kTickHz);
  for (ViewState* view : {&all, &some}) view->merge(frame(60, {row(1, {0, 0}), row(2, {5, 5})}));
  all.merge(delta(63, 60, {row(1, {1, 0}), row(2, {6, 5})}));
  for (ViewState* view : {&all, &some}) view->merge(delta(66, 60, {row(1, {2, 0})}));
  REQUIRE(all.newest()->lice.at(1).position == some.newest()->lice.at(1).position);
  REQUIRE(all.newest()->lice.at(2).position == some.newest()->lice.at(2).position);
  REQUIRE(some.newest()->lice.at(2).position == core::Vec2{5, 5});
}

TEST_CASE("a delta without its key says so and shows nothing of itself") {
  ViewState view(kTickHz);
  REQUIRE(view.merge(delta(63, 60, {row(1, {1, 1})})) == ViewState::Merge::kMissingBase);
  REQUIRE(view.newest() == nullptr);
  view.merge(frame(120, {row(1, {0, 0})}));
  REQUIRE(view.merge(delta(183, 180, {row(1, {1, 1})})) == ViewState::Merge::kMissingBase);
  REQUIRE(view.newest()->tick == 120);
}

TEST_CASE("a frame that is not newer is passed over") {
  ViewState view(kTickHz);
  view.merge(frame(120, {row(1, {0, 0})}));
  REQUIRE(view.merge(frame(120, {row(1, {7, 7})})) == ViewState::Merge::kStale);
  REQUIRE(view.merge(delta(117, 120, {row(1, {7, 7})})) == ViewState::Merge::kStale);
  REQUIRE(view.newest()->lice.at(1).position == core::Vec2{0, 0});
}

TEST_CASE(
    "who flies is drawn between both heights, and who lands or leaves the ground as the nearer frame says") {
  ViewState view(kTickHz);
  view.merge(frame(60, {row(1, {1, 1}, {}, 0.0, 3.0), row(2, {2, 2}), row(3, {3, 3})}));
  view.merge(frame(64, {row(1, {1, 1}, {}, 0.0, 5.0), row(2, {2, 2}, {}, 0.0, 7.0), row(3, {3, 3})}));
  REQUIRE(view.at(61).at(1).flight_z == Approx(3.5));
  REQUIRE(view.at(61).at(2).flight_z == 0.0);
  REQUIRE(view.at(63).at(2).flight_z == 7.0);
  REQUIRE(view.at(63).at(3).flight_z == 0.0);
}

TEST_CASE("a frame of other columns is refused") {
  ViewState view(kTickHz);
  protocol::Frame odd = frame(60, {});
  odd.columns = 3;
  odd.values = {1, 2, 3};
  REQUIRE(view.merge(odd) == ViewState::Merge::kUnreadable);
}

TEST_CASE(
    "between two snapshots a cubic motion is exact, position and distance at the snapshots themselves") {
  // x = t^3, y = 2 t^2: velocities at the ends determine the cubic.
  const auto sample = [](double t) { return row(1, {t * t * t, 2 * t * t}, {3 * t * t, 4 * t}, t); };
  ViewState view(kTickHz);
  view.merge(frame(60, {sample(1.0)}));
  view.merge(frame(90, {sample(1.5)}));
  for (double tick = 60; tick <= 90; tick += 0.5) {
    const double t = tick / 60.0;
    const auto lice = view.at(tick);
    REQUIRE(lice.at(1).position.x == Approx(t * t * t).margin(1e-12));
    REQUIRE(lice.at(1).position.y == Approx(2 * t * t).margin(1e-12));
    REQUIRE(lice.at(1).distance == Approx(t).margin(1e-12));
  }
}

TEST_CASE("the drawn path has no jump where a snapshot comes") {
  ViewState view(kTickHz);
  for (std::uint64_t tick = 60; tick <= 120; tick += 3) {
    const double a = static_cast<double>(tick) / 20.0;
    view.merge(frame(tick, {row(1, {std::cos(a), std::sin(a)}, {-3 * std::sin(a), 3 * std::cos(a)})}));
  }
  core::Vec2 last = view.at(60.0).at(1).position;
  for (double tick = 60.1; tick <= 120.0; tick += 0.1) {
    const core::Vec2 here = view.at(tick).at(1).position;
    REQUIRE(std::hypot(here.x - last.x, here.y - last.y) < 1.1 * 3.0 * 0.1 / kTickHz);
    last = here;
  }
}

TEST_CASE(
    "beyond the newest snapshot a louse goes on along its velocity for a quarter of a second and stops") {
  ViewState view(kTickHz);
  view.merge(frame(60, {row(1, {0, 0}, {2, 0})}));
  REQUIRE(view.at(66).at(1).position.x == Approx(0.2));
  REQUIRE(view.at(600).at(1).position.x == Approx(0.5));
}

TEST_CASE("a respawned louse is at one place or the other, never in flight") {
  ViewState view(kTickHz);
  view.merge(frame(60, {row(1, {-15, 0}, {1, 0})}));
  view.merge(frame(63, {row(1, {15, 0})}));
  for (double tick = 60; tick <= 63; tick += 0.25) REQUIRE(std::abs(view.at(tick).at(1).position.x) >= 15.0);
}

TEST_CASE("over a seam of a map that wraps a louse is drawn the short way, and always on the map") {
  const Ways ways({-20, -20, 20, 20}, state::Edges::kWrap);
  ViewState view(kTickHz);
  view.merge(frame(60, {row(1, {19.7, 3}, {10, -20})}));
  view.merge(frame(63, {row(1, {-19.8, 2}, {10, -20})}));
  for (double tick = 60; tick <= 66; tick += 0.125) {
    const core::Vec2 p = view.at(tick, ways).at(1).position;
    const double gone = (tick - 60) / kTickHz;
    CHECK(p.x >= -20.0);
    CHECK(p.x < 20.0);
    CHECK(ways.way({19.7, 3}, p).x == Approx(10 * gone).margin(1e-9));
    CHECK(p.y == Approx(3 - 20 * gone).margin(1e-9));
  }
}

TEST_CASE("ways on a map that wraps are never longer than half of it, and lead where they say") {
  const Ways ways({-20, -10, 20, 30}, state::Edges::kWrap);
  CHECK(ways.way({19, 0}, {-19, 0}) == core::Vec2{2, 0});
  CHECK(ways.way({-19, -9}, {19, 29}) == core::Vec2{-2, -2});
  CHECK(ways.place(core::Vec2{19, 0} + core::Vec2{2, 0}) == core::Vec2{-19, 0});
  CHECK(Ways().way({19, 0}, {-19, 0}) == core::Vec2{-38, 0});
  CHECK(Ways().place({25, 0}) == core::Vec2{25, 0});
}

TEST_CASE("a louse that left is drawn until its last snapshot and not after") {
  ViewState view(kTickHz);
  view.merge(frame(60, {row(1, {0, 0}), row(2, {1, 1})}));
  view.merge(delta(63, 60, {}, {2}));
  REQUIRE(view.at(61).contains(2));
  REQUIRE_FALSE(view.at(63).contains(2));
}

TEST_CASE("however many frames come, only so many are kept, and the newest work") {
  ViewState view(kTickHz);
  for (std::uint64_t tick = 3; tick < 30000; tick += 3) {
    view.merge(frame(tick, {row(1, {static_cast<double>(tick), 0}, {60, 0})}));
  }
  REQUIRE(view.at(29900.5).at(1).position.x == Approx(29900.5));
}
