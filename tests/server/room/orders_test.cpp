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

TEST_CASE("who is muted stays so when he comes back to his louse, and as long as was said") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join;
  join.name = "ann";
  join.may_resume = true;
  const auto ann = house.join(7, join);
  const auto bob = house.join(8);
  const auto roster = [&house] {
    std::vector<RosterEntry> entries;
    house.room->ask_roster([&entries](std::vector<RosterEntry> told) { entries = std::move(told); });
    house.settle();
    return entries;
  };
  const auto is_heard = [&house, &bob](SessionId session) {
    const std::size_t before = bob->lines.size();
    house.door->submit(session, protocol::Chat{"hello"}, house.timekeeper.now());
    house.settle();
    house.tick(4);
    return std::any_of(bob->lines.begin() + static_cast<std::ptrdiff_t>(before), bob->lines.end(),
                       [](const std::string& line) { return line.find("hello") != std::string::npos; });
  };
  CHECK(is_heard(7));
  house.room->mute(roster().at(0), std::chrono::seconds(20));
  CHECK_FALSE(is_heard(7));
  const auto* refusal = std::get_if<protocol::ErrorMessage>(&ann->answers.back());
  REQUIRE(refusal != nullptr);
  CHECK(refusal->code == "muted");
  CHECK(refusal->text == "chat: you have been muted for another 20 s");
  CHECK(is_heard(8));
  CHECK(roster().at(0).is_muted);
  CHECK_FALSE(roster().at(1).is_muted);
  house.door->leave(7, Parting::kLost);
  house.settle();
  join.resume = ann->welcomes.at(0).resume_token;
  house.join(9, join);
  CHECK_FALSE(is_heard(9));
  house.tick(20 * 60);
  CHECK(is_heard(9));
  house.room->mute(roster().at(1), std::nullopt);  // by session: bob's is 8
  house.tick(100 * 60);
  CHECK_FALSE(is_heard(9));
  house.room->unmute(roster().at(1));
  CHECK(is_heard(9));
}

TEST_CASE("who is away can be muted, and another one's louse of that number is not") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join;
  join.name = "ann";
  join.may_resume = true;
  const auto ann = house.join(7, join);
  house.door->leave(7, Parting::kLost);
  house.settle();
  const std::uint32_t louse = ann->welcomes.at(0).id;
  house.room->mute({RosterEntry::Kind::kAway, 0, louse, "eve", protocol::Role::kPlayer}, std::nullopt);
  std::vector<RosterEntry> roster;
  const auto ask = [&] {
    house.room->ask_roster([&roster](std::vector<RosterEntry> told) { roster = std::move(told); });
    house.settle();
    return roster.at(0).is_muted;
  };
  CHECK_FALSE(ask());
  house.room->mute(roster.at(0), std::nullopt);
  CHECK(ask());
}

TEST_CASE("who has come back over another connection since he was found is the one who is meant") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join;
  join.name = "ann";
  join.may_resume = true;
  const auto ann = house.join(7, join);
  const RosterEntry found{RosterEntry::Kind::kSession, 7, ann->welcomes.at(0).id, "ann",
                          protocol::Role::kPlayer};
  join.resume = ann->welcomes[0].resume_token;
  house.join(8, join);
  const auto roster = [&house] {
    std::vector<RosterEntry> entries;
    house.room->ask_roster([&entries](std::vector<RosterEntry> told) { entries = std::move(told); });
    house.settle();
    return entries;
  };
  house.room->mute(found, std::nullopt);
  CHECK(roster().at(0).is_muted);
  std::vector<SessionId> here;
  house.room->put_out({found}, [&here](std::vector<SessionId> sessions) { here = std::move(sessions); });
  house.settle();
  CHECK(here == std::vector<SessionId>{8});
  CHECK_FALSE(house.join(9, join)->welcomes.at(0).resumed);  // by a token that is worth nothing now
}

TEST_CASE("whom a recording left behind can be put out, or muted for who takes his louse over") {
  House house(test::settings(8), test::went_on());
  house.room->start([] {});
  std::vector<RosterEntry> roster;
  const auto ask = [&] {
    house.room->ask_roster([&roster](std::vector<RosterEntry> told) { roster = std::move(told); });
    house.settle();
    return roster.size();
  };
  REQUIRE(ask() == 2);
  const bool is_mara_first = roster[0].name == "mara";
  house.room->mute(roster[is_mara_first ? 0 : 1], std::nullopt);
  house.room->put_out({roster[is_mara_first ? 1 : 0]}, [](const std::vector<SessionId>&) {});
  CHECK(ask() == 1);
  house.join(1, test::named("mara"));
  REQUIRE(ask() == 1);
  CHECK(roster[0].session == 1);
  CHECK(roster[0].is_muted);
}

TEST_CASE("where the server is about to stop a made-up token is no way in") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join;
  join.name = "ann";
  join.may_resume = true;
  const auto ann = house.join(7, join);
  house.door->leave(7, Parting::kLost);
  join.fields = protocol::default_columns();
  const auto come = [&](SessionId session, const std::string& token) {
    const auto guest = std::make_shared<test::Guest>();
    join.resume = token;
    house.door->join({session, guest, join, 1, house.timekeeper.now(), false,
                      protocol::ErrorMessage{"draining", "the server stops", false, {}}});
    house.settle();
    return guest;
  };
  const auto guess = come(8, std::string(32, '0'));
  REQUIRE(guess->refusals.size() == 1);
  CHECK(guess->refusals[0].code == "draining");
  CHECK(guess->welcomes.empty());
  CHECK(come(9, ann->welcomes.at(0).resume_token)->welcomes.at(0).resumed);
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
    CHECK(slow->frames.back().tick == tick);
    const std::size_t before = ann->frames.size();
    house.door->submit(1, protocol::Resync{}, house.timekeeper.now());
    house.settle();
    CHECK(ann->frames.size() > before);
    CHECK(ann->frames.back().tick == tick);
  }
}

TEST_CASE("a room says who is in it") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join;
  join.name = "ann";
  house.join(7, join);
  join.name = "cat";
  join.role = protocol::Role::kSpectator;
  house.join(8, join);
  std::vector<RosterEntry> roster;
  house.room->ask_roster([&roster](std::vector<RosterEntry> told) { roster = std::move(told); });
  house.settle();
  REQUIRE(roster.size() == 2);
  CHECK(roster[0].name == "ann");
  CHECK(roster[0].session == 7);
  CHECK(roster[0].louse != 0);
  CHECK(roster[1].name == "cat");
  CHECK(roster[1].louse == 0);
}

}  // namespace woodlouse::server::orders_test
