#include "server/room/room.h"

#include <catch2/catch.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/room/house.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

TEST_CASE("a room's figures may be read while it runs, and are whole once it has stopped") {
  House house(settings(8));
  CHECK(house.room->figures()->ticks == 0);
  house.room->start([] {});
  house.tick(59);
  CHECK(house.room->figures()->ticks == 0);
  house.tick();
  const auto first = house.room->figures();
  CHECK(first->ticks == 60);
  CHECK(first->lateness.count() == 60);
  house.tick(5);
  CHECK(first->ticks == 60);  // a snapshot
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
  CHECK(house.room->figures()->ticks == 65);
}

TEST_CASE("ticks keep an absolute schedule: a little late is made up for, much is not") {
  House house(settings(8));
  house.room->start([] {});
  house.tick(10);
  house.timekeeper.advance(std::chrono::milliseconds(50));  // three ticks at once
  house.settle();
  house.timekeeper.advance(std::chrono::seconds(2));
  house.settle();
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
  const auto figures = house.room->figures();
  CHECK(figures->clock_moves == 1);
  CHECK(figures->ticks == 10 + 3 + 1);
  CHECK(figures->lateness.max() >= std::chrono::seconds(1));
}

TEST_CASE("a room's first tick is due at the next whole millisecond") {
  using std::chrono::microseconds;
  const auto [passed, ticks] = GENERATE(std::pair(microseconds(699), 0u), std::pair(microseconds(700), 1u));
  House house(settings(8));
  house.timekeeper.advance(microseconds(300));
  house.room->start([] {});
  house.settle();
  house.timekeeper.advance(passed);
  house.settle();
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
  CHECK(house.room->figures()->ticks == ticks);
  CHECK(house.room->figures()->lateness.max() == Duration::zero());
}

TEST_CASE("a room ends at its tick limit, once, and ticks no more") {
  RoomSettings limited = settings(8);
  limited.tick_limit = 3;
  House house(limited);
  int ended = 0;
  house.room->start([&] { ++ended; });
  house.tick(10);
  CHECK(ended == 1);
  house.room->stop({"shutdown", "the game is over", false}, "test", [] {});
  house.settle();
  CHECK(house.room->figures()->ticks == 3);
}

namespace {

/// Keeps each step when the test says so.
class Keeper final : public TickWatcher {
 public:
  explicit Keeper(std::vector<std::function<void()>>& into) : asked_(into) {}
  void begin(const match::Match&) override {}
  bool await_kept(const std::function<void()>& kept) override {
    asked_.push_back(kept);
    return true;
  }
  void finish(const std::string&, std::function<void()> done) override { done(); }

 private:
  std::vector<std::function<void()>>& asked_;
};

/// A room that a keeper watches, with somebody in it.
struct KeptHouse {
  KeptHouse() {
    Watchers watchers;
    watchers.push_back(std::make_unique<Keeper>(asked));
    RoomSettings each_tick = settings(8);
    each_tick.state_hz = 60;
    house.emplace(each_tick, House::open(), std::move(watchers));
    house->room->start([] {});
    house->tick();
    keep();
    guest = house->join(1);
    guest->frames.clear();
  }
  void keep() {
    asked.back()();
    house->settle();
  }
  std::vector<std::function<void()>> asked;
  std::optional<House> house;
  std::shared_ptr<Guest> guest;
};

}  // namespace

TEST_CASE("a step that is to be kept is shown once it is, and none is played meanwhile") {
  KeptHouse kept;
  House& house = *kept.house;
  house.tick();
  CHECK(kept.asked.size() == 2);
  CHECK(kept.guest->frames.empty());
  house.tick(3);
  house.timekeeper.advance(std::chrono::seconds(10));
  house.settle();
  CHECK(kept.asked.size() == 2);
  CHECK(kept.guest->frames.empty());
  kept.asked.front()();  // of the step before
  house.settle();
  CHECK(kept.guest->frames.empty());
  kept.keep();
  CHECK(kept.guest->frames.size() == 1);
  house.tick();
  CHECK(kept.asked.size() == 3);  // of ten seconds nothing is made up for
  kept.keep();
  CHECK(kept.guest->frames.size() == 2);
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
  CHECK(house.room->figures()->clock_moves == 0);
}

TEST_CASE("who joins, asks anew or is there when the operator pauses sees no step before it is kept") {
  KeptHouse kept;
  House& house = *kept.house;
  house.tick();
  const auto late = house.join(2);
  REQUIRE(late->welcomes.size() == 1);
  house.door->submit(1, protocol::Resync{}, Time{});
  house.settle();
  house.room->pause([](const auto& tick) { CHECK(tick); });
  house.tick(3);
  CHECK(late->frames.empty());
  CHECK(kept.guest->frames.empty());
  kept.keep();
  CHECK_FALSE(late->frames.empty());
  CHECK_FALSE(kept.guest->frames.empty());
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
}

TEST_CASE("a room that is paused, stepped or stopped while a step is kept plays as many as were asked for") {
  KeptHouse kept;
  House& house = *kept.house;
  house.tick();
  REQUIRE(kept.asked.size() == 2);
  house.room->pause([](const auto& tick) { CHECK(tick); });
  std::optional<std::uint64_t> stepped;
  house.room->step(1, [&](const auto& tick) { stepped = tick.value(); });
  house.tick(2);
  CHECK(kept.asked.size() == 2);
  kept.keep();
  CHECK_FALSE(stepped);  // what is kept now was played before
  house.tick(2);
  REQUIRE(kept.asked.size() == 3);
  kept.keep();
  REQUIRE(stepped);
  CHECK(*stepped == 3);
  house.tick(5);
  CHECK(kept.asked.size() == 3);
  house.room->resume([](const auto& tick) { CHECK(tick); });
  house.tick(2);
  REQUIRE(kept.asked.size() == 4);
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
  const std::size_t shown = kept.guest->frames.size();
  kept.keep();
  CHECK(kept.guest->frames.size() == shown);
}

TEST_CASE("within a tick inputs are acknowledged before the frame that shows what they did") {
  House house(settings(8));
  house.room->start([] {});
  house.tick();
  const auto guest = house.join(1);
  guest->order.clear();
  for (std::uint32_t seq = 1; seq <= 6; ++seq) {
    protocol::Input input;
    input.seq = seq;
    house.door->submit(1, input, house.timekeeper.now());
    house.tick();
  }
  // A frame after each third step: of the steps 2 to 7 the second and the fifth.
  CHECK(guest->order == "aafaaafa");
}

namespace {

/// Writes down what it is told, in order.
class Witness final : public TickWatcher {
 public:
  explicit Witness(std::vector<std::string>& seen) : seen_(seen) {}
  void attach(Announce announce) override { announce_ = std::move(announce); }
  void begin(const match::Match&) override { seen_.push_back("begin"); }
  void chat(std::uint64_t tick, match::PlayerId, const std::string&, const std::string& text) override {
    seen_.push_back("chat " + std::to_string(tick) + " " + text);
    announce_({"heard", text});
  }
  void step(const LiveStep& step, const match::Match&) override {
    const match::StepRecord& record = step.record();
    for (const match::RosterChange& change : record.roster)
      if (change.action == match::RosterAction::kJoin)
        seen_.push_back("player " + std::to_string(change.player) + " " + change.label.name);
    seen_.push_back("step " + std::to_string(record.tick) + " margins " +
                    std::to_string(step.margins().size()));
  }
  void rest(const match::Match& game) override { seen_.push_back("rest " + std::to_string(game.tick())); }
  void finish(const std::string& reason, std::function<void()> done) override {
    seen_.push_back("finish " + reason);
    done();
  }

 private:
  std::vector<std::string>& seen_;
  Announce announce_;
};

}  // namespace

TEST_CASE(
    "a watcher sees each step with who joined, and what was said, and the end, what it announces is heard") {
  std::vector<std::string> seen;
  Watchers watchers;
  watchers.push_back(std::make_unique<Witness>(seen));
  House house(settings(8), went_on(), std::move(watchers));
  house.room->start([] {});
  house.tick();
  const auto eve = house.join(1, named("eve"));
  protocol::Input input;
  input.thrust.value = {1.0, 0.0};
  house.door->submit(1, input, house.timekeeper.now());
  house.door->submit(1, protocol::Chat{"hi"}, house.timekeeper.now());
  house.settle();
  REQUIRE(eve->answers.size() == 1);
  CHECK(std::get<protocol::Notice>(eve->answers[0]).text == "hi");
  house.tick();
  const auto late = house.join(2, named("late"));
  REQUIRE(late->answers.size() == 1);  // what was announced is told to whoever joins later
  CHECK(std::get<protocol::Notice>(late->answers[0]).text == "hi");
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
  CHECK(seen == std::vector<std::string>{"begin", "step 1 margins 0", "rest 2", "chat 2 hi", "player 3 eve",
                                         "step 2 margins 1", "rest 3", "finish test"});
}

namespace {

/// Its work takes until a test lets it end.
class SlowWatcher final : public TickWatcher {
 public:
  explicit SlowWatcher(std::vector<std::function<void()>>& ends) : ends_(ends) {}
  void begin(const match::Match&) override {}
  void finish(const std::string&, std::function<void()> done) override { ends_.push_back(std::move(done)); }

 private:
  std::vector<std::function<void()>>& ends_;
};

}  // namespace

TEST_CASE(
    "a room that is stopped twice finishes its watchers once, and both hear of its end when the last is "
    "done") {
  std::vector<std::function<void()>> ends;
  Watchers watchers;
  watchers.push_back(std::make_unique<SlowWatcher>(ends));
  watchers.push_back(std::make_unique<SlowWatcher>(ends));
  House house(settings(8), House::open(), std::move(watchers));
  house.room->start([] {});
  house.tick(3);
  int heard = 0;
  for (int k = 0; k < 2; ++k)
    house.room->stop({"shutdown", "the server stops", false}, "test", [&] { ++heard; });
  house.settle();
  REQUIRE(ends.size() == 2);
  CHECK(heard == 0);
  CHECK(house.room->figures()->ticks == 3);  // told before its watchers end
  std::exchange(ends[0], nullptr)();
  house.settle();
  CHECK(heard == 0);
  std::exchange(ends[1], nullptr)();
  house.settle();
  CHECK(heard == 2);
  house.room->stop({}, "test", [&] { ++heard; });
  house.settle();
  CHECK(heard == 3);
  CHECK(ends.size() == 2);
}

TEST_CASE("a room that never started ends without its watchers, which never began") {
  std::vector<std::function<void()>> ends;
  Watchers watchers;
  watchers.push_back(std::make_unique<SlowWatcher>(ends));
  House house(settings(8), House::open(), std::move(watchers));
  bool stopped = false;
  house.room->stop({}, "test", [&] { stopped = true; });
  house.settle();
  CHECK(stopped);
  CHECK(ends.empty());
}

TEST_CASE("after its tick limit a room refuses who would join") {
  RoomSettings limited = settings(8);
  limited.tick_limit = 2;
  House house(limited);
  house.room->start([] {});
  house.tick(5);
  const auto late = house.join(1);
  REQUIRE(late->refusals.size() == 1);
  CHECK(late->refusals[0].code == "shutdown");
}
