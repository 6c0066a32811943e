// What an operator asks of a room: paused, stepped, recorded.
#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/room/house.h"

namespace woodlouse::server::orders_test {
namespace {

using test::House;

/// What a watcher was told, and at which tick.
using Turns = std::vector<std::pair<std::string, std::uint64_t>>;

class Witness final : public TickWatcher {
 public:
  explicit Witness(Turns& turns) : turns_(turns) {}
  void begin(const match::Match& game) override {
    CHECK(game.state().roster.empty());
    turns_.emplace_back("begin", game.tick());
  }
  void fall_asleep(const match::Match& game) override { turns_.emplace_back("asleep", game.tick()); }
  void wake(const match::Match& game) override { turns_.emplace_back("awake", game.tick()); }
  void finish(const std::string&, std::function<void()> done) override {
    turns_.emplace_back("finish", 0);
    done();
  }
  [[nodiscard]] bool is_recording() const override { return true; }

 private:
  Turns& turns_;
};

std::string code_of(const protocol::ServerMessage& message) {
  const auto* notice = std::get_if<protocol::Notice>(&message);
  return notice == nullptr ? std::string() : notice->code;
}

/// What came of an order.
struct Outcome {
  Room::Ordered take() {
    return [this](core::Expected<std::uint64_t> result) { results.push_back(std::move(result)); };
  }
  std::vector<core::Expected<std::uint64_t>> results;
};

RoomSettings of_eight() {
  RoomSettings settings;
  settings.name = "room";
  settings.limits.max_players = 8;
  return settings;
}

struct Playing {
  Playing() : house(of_eight()) {
    house.room->start([] {});
  }
  std::uint64_t tick() {
    house.settle();
    return house.room->figures()->ticks;
  }
  House house;
  Outcome outcome;
};

}  // namespace

TEST_CASE("a paused room takes no tick, whoever is there, and goes on with the next one") {
  Playing playing;
  House& house = playing.house;
  const auto guest = house.join(1);
  house.tick(5);
  house.room->pause(playing.outcome.take());
  house.settle();
  REQUIRE(playing.outcome.results.size() == 1);
  REQUIRE(playing.outcome.results[0]);
  const std::uint64_t tick = *playing.outcome.results[0];
  CHECK(code_of(guest->answers.back()) == "paused");
  CHECK(house.room->is_paused());
  house.timekeeper.advance(std::chrono::hours(1));
  house.settle();
  const auto late = house.join(2);
  REQUIRE_FALSE(late->answers.empty());
  CHECK(code_of(late->answers.front()) == "paused");
  house.room->pause(playing.outcome.take());
  house.room->resume(playing.outcome.take());
  house.settle();
  CHECK_FALSE(playing.outcome.results[1]);
  CHECK(*playing.outcome.results[2] == tick);
  CHECK(code_of(late->answers.back()) == "resumed");
  house.tick(3);
  house.room->pause(playing.outcome.take());
  house.settle();
  CHECK(*playing.outcome.results[3] > tick);
  CHECK(house.room->figures()->clock_moves == 0);
}

TEST_CASE("steps are as many as were asked for") {
  Playing playing;
  House& house = playing.house;
  house.tick(2);
  house.room->step(1, playing.outcome.take());
  house.settle();
  REQUIRE_FALSE(playing.outcome.results.at(0));
  house.room->pause(playing.outcome.take());
  house.settle();
  const std::uint64_t tick = playing.outcome.results.at(1).value();
  house.room->step(3, playing.outcome.take());
  house.tick(10);
  REQUIRE(playing.outcome.results.size() == 3);
  CHECK(playing.outcome.results[2].value() == tick + 3);
  CHECK(house.room->is_paused());
}

TEST_CASE("whoever pauses, resumes or closes a room ends the steps before") {
  Playing playing;
  House& house = playing.house;
  house.tick(2);
  for (const int how : {0, 1, 2}) {
    Outcome steps, order;
    if (!house.room->is_paused()) house.room->pause(playing.outcome.take());
    house.settle();
    house.room->step(1000, steps.take());
    house.tick(3);
    CHECK(steps.results.empty());
    if (how == 0) house.room->pause(order.take());
    if (how == 1) house.room->resume(order.take());
    if (how == 2) house.room->stop({"shutdown", "", false}, "", [] {});
    house.settle();
    REQUIRE(steps.results.size() == 1);
    CHECK_FALSE(steps.results[0]);
  }
  house.room->pause(playing.outcome.take());
  house.settle();
  CHECK_FALSE(playing.outcome.results.back());
}

TEST_CASE("a recording begins between two ticks, and ends while the game goes on") {
  Playing playing;
  House& house = playing.house;
  Turns turns;
  const auto guest = house.join(1);
  house.tick(2);
  std::uint64_t game = 0;
  house.room->ask_header("test", [&game](const replay::Header& header, std::uint64_t number) {
    CHECK(header.map_file == "maps/volcano.json");
    game = number;
  });
  house.settle();
  house.room->record(std::make_unique<Witness>(turns), game, playing.outcome.take());
  house.settle();
  CHECK(house.room->is_recorded());
  house.room->record(std::make_unique<Witness>(turns), game, playing.outcome.take());
  house.settle();
  CHECK_FALSE(playing.outcome.results.at(1));
  house.room->end_recording("the operator", playing.outcome.take());
  house.tick(2);
  CHECK_FALSE(house.room->is_recorded());
  house.room->end_recording("the operator", playing.outcome.take());
  house.room->record(std::make_unique<Witness>(turns), game + 1, playing.outcome.take());
  house.settle();
  CHECK_FALSE(playing.outcome.results.at(3));
  CHECK_FALSE(playing.outcome.results.at(4));
  REQUIRE(turns.size() == 2);
  CHECK(turns[0].first == "begin");
  CHECK(turns[1].first == "finish");
}

TEST_CASE("a recording that is asked for while somebody is about to join begins behind the next step") {
  Playing playing;
  House& house = playing.house;
  Turns turns;
  house.tick(2);
  house.room->pause(playing.outcome.take());
  house.settle();
  const auto guest = house.join(1);
  house.room->record(std::make_unique<Witness>(turns), 1, playing.outcome.take());
  house.settle();
  CHECK(turns.empty());
  CHECK(house.room->is_recorded());
  house.room->step(1, playing.outcome.take());
  house.tick(3);
  REQUIRE(turns.size() == 2);
  CHECK(turns[0].first == "begin");
  CHECK(turns[1].first == "asleep");
  CHECK(turns[0].second == turns[1].second);
}

TEST_CASE("a room that stands still shows where, to who is shown half of the frames as well") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join;
  join.name = "ann";
  const auto ann = house.join(1, join);
  join.name = "slow";
  join.state_hz = 2;
  const auto slow = house.join(2, join);
  house.tick(6);
  house.room->pause(playing.outcome.take());
  house.settle();
  for (int k = 0; k < 4; ++k) {  // a frame comes each third tick
    house.room->step(1, playing.outcome.take());
    house.tick(3);
    const std::uint64_t tick = playing.outcome.results.back().value();
    CHECK(ann->frames.back().tick == tick);
    CHECK(slow->again.back().tick == tick);  // what comes in turn it is not shown each time
    const std::size_t before = ann->frames.size();
    house.door->submit(1, protocol::Resync{}, house.timekeeper.now());
    house.settle();
    CHECK(ann->frames.size() > before);
    CHECK(ann->frames.back().tick == tick);
  }
}

}  // namespace woodlouse::server::orders_test
