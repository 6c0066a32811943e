// A room in which nobody is stands still: no timer, no tick, until somebody joins.
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/room/house.h"

namespace woodlouse::server::test {
namespace {

constexpr int kTenSeconds = 600;

/// Counts steps, and keeps where the room fell asleep and woke.
class Watch final : public TickWatcher {
 public:
  struct Seen {
    std::uint64_t steps = 0;
    std::vector<std::pair<std::string, std::uint64_t>> turns;
  };
  explicit Watch(Seen& seen) : seen_(seen) {}
  void begin(const match::Match&) override {}
  void step(const LiveStep& step, const match::Match&) override {
    CHECK(step.record().tick == seen_.steps++);  // no tick is left out
  }
  void fall_asleep(const match::Match& game) override { seen_.turns.emplace_back("asleep", game.tick()); }
  void wake(const match::Match& game) override { seen_.turns.emplace_back("awake", game.tick()); }
  void finish(const std::string&, std::function<void()> done) override { done(); }

 private:
  Seen& seen_;
};

/// A room that counts; its timer runs.
struct Watched {
  explicit Watched(RoomSettings settings, Start start = House::open()) : first(start.match->tick()) {
    seen.steps = first;
    Watchers watchers;
    watchers.push_back(std::make_unique<Watch>(seen));
    house = std::make_unique<House>(std::move(settings), std::move(start), std::move(watchers));
    house->room->start([] {});
  }
  std::uint64_t first;
  Watch::Seen seen;
  std::unique_ptr<House> house;
};

RoomSettings with_bots(std::uint32_t bots) {
  RoomSettings result = settings(8);
  result.bots = bots;
  return result;
}

}  // namespace

TEST_CASE("a room that nobody enters stands still after ten seconds, and whoever joins finds the next tick") {
  Watched watched(settings(8));
  House& house = *watched.house;
  house.tick(kTenSeconds - 1);
  CHECK(watched.seen.turns.empty());
  CHECK(house.timekeeper.pending() == 1);
  house.tick();
  CHECK(watched.seen.turns == std::vector<std::pair<std::string, std::uint64_t>>{{"asleep", kTenSeconds}});
  CHECK(house.timekeeper.pending() == 0);
  house.timekeeper.advance(std::chrono::hours(20));
  house.settle();
  CHECK(watched.seen.steps == kTenSeconds);
  CHECK(house.room->figures()->sleeps == 1);
  CHECK(house.room->figures()->ticks == kTenSeconds);

  const auto ada = house.join(1, named("ada"));
  house.settle();
  CHECK(ada->welcomes.at(0).tick == kTenSeconds);
  CHECK(watched.seen.turns.back() == std::pair<std::string, std::uint64_t>{"awake", kTenSeconds});
  house.tick(30);
  // The first one is due when she comes; nothing is made up for.
  CHECK(watched.seen.steps == kTenSeconds + 31);
  CHECK(house.room->figures()->clock_moves == 0);
}

TEST_CASE("a room sleeps again when its last guest has gone and his louse is out, spectators count too") {
  Watched watched(settings(8));
  House& house = *watched.house;
  const auto eve = house.join(1, named("eve", protocol::Role::kSpectator));
  house.tick(3 * kTenSeconds);
  CHECK(watched.seen.turns.empty());
  house.door->leave(1, Parting::kLeft);
  house.settle();
  house.tick(kTenSeconds);
  REQUIRE(watched.seen.turns.size() == 1);
  const auto ada = house.join(2, named("ada"));
  house.tick(10);
  house.door->leave(2, Parting::kLeft);
  house.settle();
  house.tick(kTenSeconds + 10);
  CHECK(watched.seen.turns.size() == 3);
  CHECK(watched.seen.turns.back().first == "asleep");
}

TEST_CASE("the house's bots stand still with the room, or play on where the operator says so") {
  Watched standing(with_bots(3));
  standing.house->tick(2 * kTenSeconds);
  CHECK(standing.seen.turns == std::vector<std::pair<std::string, std::uint64_t>>{{"asleep", kTenSeconds}});

  RoomSettings playing = with_bots(3);
  playing.bots_alone_play = true;
  Watched awake(playing);
  awake.house->tick(3 * kTenSeconds);
  CHECK(awake.seen.turns.empty());
  CHECK(awake.seen.steps == 3 * kTenSeconds);

  playing.bots = 0;  // nobody's bots keep nothing awake
  Watched empty(playing);
  empty.house->tick(kTenSeconds);
  CHECK(empty.seen.turns.size() == 1);
}

TEST_CASE("a louse that nobody claims is waited for until it rests") {
  Watched watched(settings(8), went_on());
  House& house = *watched.house;
  house.tick(kTenSeconds);
  CHECK(watched.seen.turns.empty());  // mara's still drives
  CHECK(watched.seen.steps == watched.first + kTenSeconds);
}

TEST_CASE("a room that ends by itself does not stand still before") {
  RoomSettings limited = settings(8);
  limited.tick_limit = 2 * kTenSeconds;
  bool ended = false;
  House house(limited);
  house.room->start([&] { ended = true; });
  house.tick(2 * kTenSeconds);
  CHECK(ended);
}

TEST_CASE("a room can be stopped in its sleep") {
  Watched watched(settings(8));
  House& house = *watched.house;
  house.tick(kTenSeconds);
  REQUIRE(watched.seen.turns.size() == 1);
  bool stopped = false;
  house.room->stop({"shutdown", "the server stops", false}, "test", [&] { stopped = true; });
  house.settle();
  CHECK(stopped);
  const auto late = house.join(1, named("late"));
  house.settle();
  CHECK(watched.seen.turns.size() == 1);
}

}  // namespace woodlouse::server::test
