// What an operator asks of a room about people: muted, put out, told of.
#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/room/house.h"

namespace woodlouse::server::people_test {
namespace {

using test::House;

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
  House house;
};

protocol::Join who_may_resume(const std::string& name) {
  protocol::Join join = test::named(name);
  join.may_resume = true;
  return join;
}

std::vector<RosterEntry> roster_of(House& house) {
  std::vector<RosterEntry> entries;
  house.room->ask_roster([&entries](std::vector<RosterEntry> told) { entries = std::move(told); });
  house.settle();
  return entries;
}

}  // namespace

TEST_CASE("who is muted stays so when he comes back to his louse, and as long as was said") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join = who_may_resume("ann");
  const auto ann = house.join(7, join);
  const auto bob = house.join(8);
  const auto is_heard = [&house, &bob](SessionId session) {
    const std::size_t before = bob->lines.size();
    house.door->submit(session, protocol::Chat{"hello"}, house.timekeeper.now());
    house.settle();
    house.tick(4);
    return std::any_of(bob->lines.begin() + static_cast<std::ptrdiff_t>(before), bob->lines.end(),
                       [](const std::string& line) { return line.find("hello") != std::string::npos; });
  };
  CHECK(is_heard(7));
  house.room->mute(roster_of(house).at(0), std::chrono::seconds(20));
  CHECK_FALSE(is_heard(7));
  const auto* refusal = std::get_if<protocol::ErrorMessage>(&ann->answers.back());
  REQUIRE(refusal != nullptr);
  CHECK(refusal->code == "muted");
  CHECK(refusal->text == "chat: you have been muted for another 20 s");
  CHECK(is_heard(8));
  CHECK(roster_of(house).at(0).is_muted);
  CHECK_FALSE(roster_of(house).at(1).is_muted);
  house.door->leave(7, Parting::kLost);
  house.settle();
  join.resume = ann->welcomes.at(0).resume_token;
  house.join(9, join);
  CHECK_FALSE(is_heard(9));
  house.tick(20 * 60);
  CHECK(is_heard(9));
  house.room->mute(roster_of(house).at(1), std::nullopt);  // by session: bob's is 8
  house.tick(100 * 60);
  CHECK_FALSE(is_heard(9));
  house.room->unmute(roster_of(house).at(1));
  CHECK(is_heard(9));
}

TEST_CASE("who is away can be muted, and another one's louse of that number is not") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join = who_may_resume("ann");
  const auto ann = house.join(7, join);
  house.door->leave(7, Parting::kLost);
  house.settle();
  const std::uint32_t louse = ann->welcomes.at(0).id;
  house.room->mute({RosterEntry::Kind::kAway, 0, louse, "eve", protocol::Role::kPlayer}, std::nullopt);
  CHECK_FALSE(roster_of(house).at(0).is_muted);
  house.room->mute(roster_of(house).at(0), std::nullopt);
  CHECK(roster_of(house).at(0).is_muted);
}

TEST_CASE("who has come back over another connection since he was found is the one who is meant") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join = who_may_resume("ann");
  const auto ann = house.join(7, join);
  const RosterEntry found{RosterEntry::Kind::kSession, 7, ann->welcomes.at(0).id, "ann",
                          protocol::Role::kPlayer};
  join.resume = ann->welcomes[0].resume_token;
  house.join(8, join);
  house.room->mute(found, std::nullopt);
  CHECK(roster_of(house).at(0).is_muted);
  std::vector<SessionId> here;
  house.room->put_out({found}, [&here](std::vector<SessionId> sessions) { here = std::move(sessions); });
  house.settle();
  CHECK(here == std::vector<SessionId>{8});
  CHECK_FALSE(house.join(9, join)->welcomes.at(0).resumed);  // by a token that is worth nothing now
}

TEST_CASE("whom a recording left behind can be put out, or muted for who takes his louse over") {
  House house(test::settings(8), test::went_on());
  house.room->start([] {});
  std::vector<RosterEntry> roster = roster_of(house);
  REQUIRE(roster.size() == 2);
  const bool is_mara_first = roster[0].name == "mara";
  house.room->mute(roster[is_mara_first ? 0 : 1], std::nullopt);
  house.room->put_out({roster[is_mara_first ? 1 : 0]}, [](const std::vector<SessionId>&) {});
  CHECK(roster_of(house).size() == 1);
  house.join(1, test::named("mara"));
  roster = roster_of(house);
  REQUIRE(roster.size() == 1);
  CHECK(roster[0].session == 1);
  CHECK(roster[0].is_muted);
}

TEST_CASE("where the server is about to stop a made-up token is no way in") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join = who_may_resume("ann");
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

TEST_CASE("a room says who is in it") {
  Playing playing;
  House& house = playing.house;
  protocol::Join join;
  join.name = "ann";
  house.join(7, join);
  join.name = "cat";
  join.role = protocol::Role::kSpectator;
  house.join(8, join);
  const std::vector<RosterEntry> roster = roster_of(house);
  REQUIRE(roster.size() == 2);
  CHECK(roster[0].name == "ann");
  CHECK(roster[0].session == 7);
  CHECK(roster[0].louse != 0);
  CHECK(roster[1].name == "cat");
  CHECK(roster[1].louse == 0);
}

}  // namespace woodlouse::server::people_test
