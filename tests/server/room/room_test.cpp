#include "server/room/room.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "tests/server/room/house.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

TEST_CASE("a guest is welcomed with who is there, then shown a key, then hears of its own coming") {
  House house(settings(8));
  const auto mara = house.join(1);
  protocol::Join eye;
  eye.role = protocol::Role::kSpectator;
  const auto spectator = house.join(2, eye);
  REQUIRE(mara->welcomes.size() == 1);
  CHECK(mara->welcomes[0].players.empty());
  CHECK(mara->welcomes[0].id != 0);
  CHECK(mara->frames.front().kind == FrameKind::kKey);
  CHECK(mara->lines.size() == 2);
  REQUIRE(spectator->welcomes.size() == 1);
  CHECK(spectator->welcomes[0].id == 0);
  REQUIRE(spectator->welcomes[0].players.size() == 1);
  CHECK(spectator->welcomes[0].players[0].name == "guest1");
  CHECK(spectator->lines.size() == 1);
  const protocol::RoomEntry census = house.room->census();
  CHECK(census.players == 1);
  CHECK(census.spectators == 1);
}

TEST_CASE("a full room refuses, and takes again when one has left") {
  House house(settings(2));
  house.join(1);
  house.join(2);
  const auto third = house.join(3);
  REQUIRE(third->refusals.size() == 1);
  CHECK(third->refusals[0].code == "room_full");
  CHECK_FALSE(third->refusals[0].fatal);
  CHECK(third->welcomes.empty());
  house.door->leave(1);
  CHECK(house.join(4)->welcomes.size() == 1);
}

TEST_CASE("who asks for one row layout too many is served a wider one, and told so") {
  House house(settings(100));
  protocol::Join join;
  join.fields = {protocol::Column::kId};
  std::vector<std::shared_ptr<Guest>> guests;
  for (SessionId session = 1; session <= Channels::kMaxRareLayouts + 4; ++session) {
    if (session % 2 == 0) join.fields.push_back(static_cast<protocol::Column>(session / 2));
    join.format = session % 2 == 0 ? protocol::Format::kExact : protocol::Format::kQuantized;
    guests.push_back(house.join(session, join));
  }
  REQUIRE(guests.back()->welcomes.size() == 1);
  CHECK(guests.back()->welcomes[0].fields.size() == protocol::kColumnCount);
  join.fields = {protocol::Column::kId};
  join.format = protocol::Format::kQuantized;
  CHECK(house.join(99, join)->welcomes.at(0).fields == join.fields);
}

TEST_CASE("the frame rate granted divides the room's and is the nearest below the wish") {
  House house(settings(100));
  const auto [wish, granted] = GENERATE(table<std::uint32_t, std::uint32_t>(
      {{1, 1}, {3, 2}, {7, 5}, {10, 10}, {19, 10}, {20, 20}, {1000, 20}}));
  protocol::Join join;
  join.state_hz = wish;
  const auto guest = house.join(1, join);
  CHECK(guest->welcomes.at(0).state_hz == granted);
  CHECK(guest->divisor == 20 / granted);
}

TEST_CASE("what a session says after it left, or after it was refused, changes nothing") {
  House house(settings(1));
  house.join(1);
  const auto refused = house.join(2);
  house.door->submit(2, protocol::Chat{"let me in"}, {});
  house.door->submit(2, protocol::Input{}, {});
  house.door->leave(2);
  house.door->leave(1);
  house.door->leave(1);
  house.door->submit(1, protocol::Chat{"still here"}, {});
  house.settle();
  CHECK(refused->answers.empty());
  const auto next = house.join(3);
  CHECK(next->lines.size() == 1);
  CHECK(house.room->census().players == 1);
}

TEST_CASE("more chat than the broadcaster hands out is refused with the time to wait, no event is lost") {
  House house(settings(8));
  const auto mara = house.join(1);
  const std::size_t before = mara->lines.size();
  // The room works, the broadcaster does not get to run: its backlog grows.
  const std::size_t said = 2 * Broadcaster::kMaxBacklog;
  for (std::size_t i = 0; i < said; ++i) house.door->submit(1, protocol::Chat{"spam"}, {});
  house.ticks.run();
  house.settle();
  const std::size_t heard = mara->lines.size() - before;
  CHECK(heard < said);
  REQUIRE(mara->answers.size() == said - heard);
  CHECK(std::get<protocol::ErrorMessage>(mara->answers[0]).code == "rate_limited");
  CHECK(std::get<protocol::ErrorMessage>(mara->answers[0]).retry_after_ms.has_value());
}

TEST_CASE("a room that stops says bye to everyone and takes nobody more") {
  House house(settings(8));
  const auto mara = house.join(1);
  bool stopped = false;
  house.room->stop({"shutdown", "the server stops", false}, "test", [&stopped] { stopped = true; });
  house.settle();
  CHECK(stopped);
  REQUIRE(mara->byes.size() == 1);
  CHECK(mara->byes[0].code == "shutdown");
  CHECK(house.join(2)->refusals.size() == 1);
}

TEST_CASE(
    "who is only in the recording is named to guests, and keeps a louse until somebody takes it over by "
    "name") {
  House house(settings(8), went_on());
  const auto eve = house.join(1, named("mara", protocol::Role::kSpectator));
  REQUIRE(eve->welcomes.size() == 1);
  REQUIRE(eve->welcomes[0].players.size() == 2);
  CHECK(eve->welcomes[0].players[0].id == 1);
  CHECK(eve->welcomes[0].players[0].name == "mara");
  CHECK(eve->welcomes[0].players[1].role == protocol::Role::kBot);
  CHECK(eve->welcomes[0].id == 0);
  CHECK(eve->welcomes[0].tick == 1);

  CHECK(house.join(2, named("timo"))->welcomes.at(0).id == 3);
  const auto mara = house.join(3, named("mara"));
  CHECK(mara->welcomes.at(0).id == 1);
  CHECK(mara->welcomes[0].players.size() == 3);  // Rolly, the spectator and timo
  CHECK(house.join(4, named("mara"))->welcomes.at(0).id == 4);
}

TEST_CASE("whoever took a louse over counts its inputs from the start and is answered in that count") {
  House house(settings(8), went_on());
  const auto mara = house.join(1, named("mara"));
  protocol::Input input;
  input.seq = 0;
  input.thrust.value = {1.0, 0.0};
  house.door->submit(1, input, house.timekeeper.now());
  input.seq = 0;
  house.door->submit(1, input, house.timekeeper.now());
  house.settle();
  REQUIRE(mara->answers.size() == 1);  // of the second one; its ack would pass for the first one's
  CHECK(std::get<protocol::ErrorMessage>(mara->answers[0]).code == "stale_seq");
  house.room->start([] {});
  house.tick();
  REQUIRE(mara->answers.size() == 2);
  const auto& ack = std::get<protocol::Ack>(mara->answers[1]);
  CHECK(ack.seq == 0);
  CHECK(ack.tick == 1);
  CHECK_FALSE(ack.dropped);
  CHECK(ack.you->louse.id == 1);
}

TEST_CASE("the house's bots take over the lice of bots of their name") {
  const std::string name = HouseBot(0, 0).name();
  Start start = went_on();
  start.unclaimed[1].name = name;
  RoomSettings with_bots = settings(8);
  with_bots.bots = 2;
  House house(with_bots, std::move(start));
  house.room->start([] {});
  house.tick(30);
  const auto eve = house.join(1, named("eve", protocol::Role::kSpectator));
  REQUIRE(eve->welcomes.size() == 1);
  const auto& players = eve->welcomes[0].players;
  REQUIRE(players.size() == 3);  // mara, and two bots, one of them on a louse of its own
  CHECK(players[0].name == "mara");
  CHECK(players[1].name == name);
  CHECK(players[1].id == 2);
  CHECK(players[2].id == 3);
}
