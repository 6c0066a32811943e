#include "shared/match/live_error.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "shared/map/map_file.h"
#include "shared/map/map_world.h"
#include "shared/match/found_lice.h"

using namespace woodlouse;
using namespace woodlouse::match;

namespace {

constexpr double kLiveTick = 1.0 / 60;

std::shared_ptr<const map::Map> crater() {
  auto loaded = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  REQUIRE(loaded);
  return *loaded;
}

/// A louse as the steps of so many ticks find it, pushed now and then.
std::vector<state::Louse> driven(const map::Map& map, std::size_t ticks) {
  physics::World world = map::make_world(map, kLiveTick);
  state::Louse louse;
  louse.id = 7;
  louse.position = {5, 1};
  louse.velocity = {1, 2};
  world.insert(louse);
  std::vector<state::Louse> found;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    if (tick % 40 == 0)
      world.set_thrust(7, {state::ThrustKind::kMapVector, {tick % 80 == 0 ? 0.75 : -0.5, 0.25}}, 25);
    found.push_back(*world.find(7));
    world.step();
  }
  return found;
}

/// What the whole play says, as a recording's inspection does.
struct Whole {
  Whole(const map::Map& map, const std::vector<state::Louse>& found)
      : error(map, kLiveTick, state::Mode::kRoam), twin(map, kLiveTick, state::Mode::kRoam) {
    for (std::size_t tick = 0; tick < found.size(); ++tick) {
      error.observe({&found[tick], 1}, tick);
      twin.observe({&found[tick], 1}, error.stepped());
    }
  }
  StepError error;
  Twin twin;
};

}  // namespace

TEST_CASE("tick by tick the error figure is the one of the whole play, and so is the twin's way off") {
  const auto map = crater();
  const std::vector<state::Louse> found = driven(*map, 1250);
  const Whole whole(*map, found);
  LiveError live(*map, kLiveTick, state::Mode::kRoam);
  CHECK_FALSE(live.reading());
  for (std::size_t tick = 0; tick < found.size(); ++tick) {
    live.find(found[tick], tick);
    live.count(1);
    REQUIRE(live.reading());
    if (tick == 59) CHECK(live.reading()->apart_seconds == Approx(1.0));
  }
  const ErrorReading reading = *live.reading();
  const ErrorFigure& figure = whole.error.figures().at(7);
  CHECK(reading.of_play == whole.error.of_play(figure));
  CHECK(reading.worst == figure.worst);
  CHECK(reading.worst_tick == figure.worst_tick);
  CHECK(reading.seconds == Approx(1250 * kLiveTick));
  REQUIRE(whole.twin.divergences().at(7).size() == 2);
  CHECK(reading.apart == whole.twin.divergences().at(7)[1]);
  CHECK(reading.apart_seconds == Twin::kSeconds);
}

TEST_CASE("a tick counts once, as it was found last, and not before it has settled") {
  const auto map = crater();
  const std::vector<state::Louse> found = driven(*map, 300);
  const Whole whole(*map, found);
  constexpr std::uint64_t kSettling = 60;
  LiveError live(*map, kLiveTick, state::Mode::kRoam, kSettling);
  for (std::uint64_t tick = 0; tick < found.size(); ++tick) {
    live.find(found[tick], tick);
    live.count(8);
    if (tick < kSettling) REQUIRE_FALSE(live.reading());
    if (tick % 30 != 29) continue;
    // Twenty ticks on it was believed elsewhere, and then run again from twenty ticks back as it was.
    for (std::uint64_t ahead = tick + 1; ahead <= tick + 20; ++ahead) {
      state::Louse wrong = found[tick];
      wrong.velocity.x += 3.0;
      live.find(wrong, ahead);
    }
    for (std::uint64_t again = tick - 20; again <= tick; ++again) live.find(found[again], again);
  }
  const std::uint64_t counted = found.size() - kSettling;
  const Whole same(*map, {found.begin(), found.begin() + static_cast<std::ptrdiff_t>(counted)});
  const ErrorReading reading = *live.reading();
  CHECK(reading.seconds == Approx(static_cast<double>(counted) * kLiveTick));
  CHECK(reading.of_play == same.error.of_play(same.error.figures().at(7)));
  CHECK(reading.apart == same.twin.apart(7)->metres);
  live.find(found[3], 3);  // long counted
  live.count(1000);
  CHECK(live.reading()->seconds == reading.seconds);
}

TEST_CASE("what never was play is forgotten, and who was moved begins a window of the twin anew") {
  const auto map = crater();
  const std::vector<state::Louse> found = driven(*map, 700);
  LiveError live(*map, kLiveTick, state::Mode::kRoam, 10);
  for (std::uint64_t tick = 0; tick < 100; ++tick) live.find(found[tick], tick);
  live.forget_waiting();
  live.count(1000);
  CHECK_FALSE(live.reading());
  for (std::uint64_t tick = 200; tick < 300; ++tick) live.find(found[tick], tick);
  live.count(30);  // no more at once
  CHECK(live.reading()->seconds == Approx(30 * kLiveTick));
  CHECK(live.reading()->apart_seconds == Approx(30 * kLiveTick));
  live.forget_waiting();  // a respawn: elsewhere
  for (std::uint64_t tick = 300; tick < 330; ++tick) live.find(found[tick + 200], tick);
  live.count(1000);
  CHECK(live.reading()->seconds == Approx(50 * kLiveTick));
  CHECK(live.reading()->apart_seconds == Approx(20 * kLiveTick));
}

TEST_CASE("lice are found with a step's inputs, without those that it puts elsewhere") {
  const auto map = crater();
  FoundLice lice(*map, kLiveTick, state::Mode::kRoam);
  std::vector<state::Louse> before = driven(*map, 1);
  before.push_back(before[0]);
  before[1].id = 9;
  StepRecord step;
  step.inputs.push_back({7, 1, {1.0, 0.0}, state::ThrustKind::kMapVector, 5, 0});
  step.inputs.push_back({8, 1, {1.0, 0.0}, state::ThrustKind::kMapVector, 5, 0});
  RosterChange change;
  change.player = 9;
  step.roster.push_back(change);
  const std::span<const state::Louse> found = lice.find(before, step);
  REQUIRE(found.size() == 1);
  CHECK(found[0].id == 7);
  CHECK(found[0].position == before[0].position);
  CHECK(found[0].thrust_ticks == 5);
}
