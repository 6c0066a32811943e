#include "server/room/room.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "server/room/welcome.h"
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
  CHECK(mara->lines.size() == 1);  // of a spectator nobody hears
  REQUIRE(spectator->welcomes.size() == 1);
  CHECK(spectator->welcomes[0].id == 0);
  REQUIRE(spectator->welcomes[0].players.size() == 1);
  CHECK(spectator->welcomes[0].players[0].name == "guest1");
  CHECK(spectator->lines.empty());
  CHECK(spectator->welcomes[0].spectators == 1);
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
  house.door->leave(1, Parting::kLeft);
  CHECK(house.join(4)->welcomes.size() == 1);
}

TEST_CASE("who asks for one row layout too many is served a wider one, and told so") {
  House house(settings(100));
  protocol::Join join;
  join.fields = {protocol::Column::kId};
  std::vector<std::shared_ptr<Guest>> guests;
  for (SessionId session = 1; session <= Layouts::kMostRare + 4; ++session) {
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

TEST_CASE("who is shown a part gets sheets of its own layout, and as a spectator ten of them a second") {
  House house(settings(100));
  protocol::Join join;
  join.view.emplace().rows = 5;
  const auto player = house.join(1, join);
  join.role = protocol::Role::kSpectator;
  const auto spectator = house.join(2, join);
  join.state_hz = 20;
  const auto eager = house.join(3, join);
  const auto plain = house.join(4);
  house.room->start([] {});
  protocol::Join eye;
  eye.role = protocol::Role::kSpectator;
  CHECK(player->welcomes.at(0).state_hz == 20);
  CHECK(spectator->welcomes.at(0).state_hz == 10);
  CHECK(eager->welcomes.at(0).state_hz == 20);
  CHECK(player->welcomes.at(0).view_rows == protocol::kEveryRow);
  CHECK(plain->welcomes.at(0).view_rows == protocol::kEveryRow);
  house.tick(7);
  CHECK(wanted_state_hz(eye, true) == 10u);
  CHECK_FALSE(wanted_state_hz(eye, false));
  eye.role = protocol::Role::kPlayer;
  CHECK_FALSE(wanted_state_hz(eye, true));
  for (const auto& guest : {player, spectator, eager})
    for (const Frame& frame : guest->frames) CHECK((frame.sheet && !frame.text));
  for (const Frame& frame : plain->frames) CHECK((!frame.sheet && frame.text));
  CHECK(plain->frames.size() == player->frames.size());
}

TEST_CASE("who turns to a part, or back to all, does so with a key, and misses no frame") {
  House house(settings(100));
  const auto guest = house.join(1);
  const auto other = house.join(2);
  house.room->start([] {});
  house.tick(5);
  protocol::View part;
  part.radius = 5.0;
  house.door->submit(1, protocol::Look{part}, house.timekeeper.now());
  house.tick(70);
  house.door->submit(1, protocol::Look{}, house.timekeeper.now());
  house.tick(130);
  REQUIRE(guest->frames.size() == other->frames.size());
  std::string kinds;
  for (const Frame& frame : guest->frames) {
    CHECK(static_cast<bool>(frame.sheet) != static_cast<bool>(frame.text));
    const char kind = frame.sheet ? 's' : 't';
    if (!kinds.empty() && kinds.back() == kind) continue;
    CHECK(frame.kind == FrameKind::kKey);
    kinds.push_back(kind);
  }
  CHECK(kinds == "tst");
  for (const Frame& frame : other->frames) CHECK(frame.text);
}

TEST_CASE("who goes, or is asked for twice, while it is about to turn does no harm") {
  House house(settings(100));
  house.join(1);
  const auto guest = house.join(2);
  house.room->start([] {});
  protocol::View part;
  part.rows = 1;
  house.door->submit(1, protocol::Look{part}, house.timekeeper.now());
  house.door->submit(2, protocol::Look{part}, house.timekeeper.now());
  house.door->submit(2, protocol::Look{}, house.timekeeper.now());
  house.door->leave(1, Parting::kLeft);
  house.tick(130);
  for (const Frame& frame : guest->frames) CHECK(frame.text);
}

TEST_CASE("where the server allows frames of so many rows, everybody is shown a part") {
  RoomSettings capped = settings(100);
  capped.limits.frame_rows = 30;
  House house(std::move(capped));
  const auto plain = house.join(1);
  CHECK(plain->welcomes.at(0).view_rows == 30);
  CHECK(plain->frames.at(0).sheet);
}

TEST_CASE("what a session says after it left, or after it was refused, changes nothing") {
  House house(settings(1));
  house.join(1);
  const auto refused = house.join(2);
  house.door->submit(2, protocol::Chat{"let me in"}, {});
  house.door->submit(2, protocol::Input{}, {});
  house.door->leave(2, Parting::kLeft);
  house.door->leave(1, Parting::kLeft);
  house.door->leave(1, Parting::kLeft);
  house.door->submit(1, protocol::Chat{"still here"}, {});
  house.settle();
  CHECK(refused->answers.empty());
  const auto next = house.join(3);
  CHECK(next->lines.size() == 1);
  CHECK(house.room->census().players == 1);
}

TEST_CASE("more chat than the broadcaster hands out is refused with the time to wait, no event is lost") {
  RoomSettings talkative = settings(8);
  talkative.limits.chat_per_s_room = 1'000'000;
  House house(talkative);
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
  CHECK(mara->welcomes[0].players.size() == 2);  // Rolly and timo
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

TEST_CASE("a room has a budget for what everybody hears") {
  House house(settings(8));
  const auto mara = house.join(1);
  const std::size_t before = mara->lines.size();
  // Less what is left for other addresses.
  const std::uint32_t most = protocol::Limits{}.chat_per_s_room * (protocol::kSavedSeconds - 1);
  for (std::uint32_t k = 0; k < most + 10; ++k) house.door->submit(1, protocol::Chat{"spam"}, Time{});
  house.settle();
  CHECK(mara->lines.size() - before == most);
  CHECK(mara->answers.size() == 10);
  house.door->submit(1, protocol::Respawn{}, Time{});
  house.settle();
  CHECK(mara->lines.back().find("respawned") != std::string::npos);
}

TEST_CASE("of two of a name the second is told another, and so is everybody") {
  House house(settings(8));
  const auto first = house.join(1, named("ann"));
  CHECK(house.join(2, named("ann", protocol::Role::kSpectator))->welcomes.at(0).name == "ann#2");
  CHECK(house.join(3, named("ann"))->welcomes.at(0).name == "ann#3");
  CHECK(first->lines.back().find("\"ann#3\"") != std::string::npos);
}

TEST_CASE("of a player's inputs a step takes so many, a later one takes the last one's place, told at once") {
  House house(settings(8));
  const auto mara = house.join(1);
  const std::uint32_t most = protocol::Limits{}.inputs_per_tick;
  protocol::Input input;
  for (input.seq = 1; input.seq <= most + 3; ++input.seq) {
    input.thrust.value = {input.seq == most + 3 ? -0.5 : 0.25, 0.0};
    house.door->submit(1, input, house.timekeeper.now());
  }
  house.settle();
  REQUIRE(mara->answers.size() == 6);  // an error and an ack each
  CHECK(std::get<protocol::ErrorMessage>(mara->answers[0]).code == "queue_full");
  CHECK(std::get<protocol::Ack>(mara->answers[1]).seq == most);
  CHECK(std::get<protocol::Ack>(mara->answers[1]).dropped);
  house.room->start([] {});
  house.tick();
  REQUIRE(mara->answers.size() == 6 + most);
  const auto& last = std::get<protocol::Ack>(mara->answers.back());
  CHECK(last.seq == most + 3);
  CHECK(last.you->louse.thrust.x == -0.5);
}

TEST_CASE("what a session says behind its join is heard, however many come before it") {
  House house(settings(2000));
  std::vector<std::shared_ptr<Guest>> guests;
  for (SessionId session = 1; session <= 300; ++session) {
    guests.push_back(std::make_shared<Guest>());
    protocol::Join join = named("eye", protocol::Role::kSpectator);
    join.fields = protocol::default_columns();
    house.door->join({session, guests.back(), join, session, Time{}});
    house.door->submit(session, protocol::GetMap{}, Time{});
    house.door->leave(session, Parting::kLeft);
    // Each look at the clock is a millisecond: a slice ends after every join.
    house.timekeeper.advance(std::chrono::milliseconds(1));
  }
  house.settle();
  for (const auto& guest : guests) {
    REQUIRE(guest->welcomes.size() == 1);
    REQUIRE(guest->maps.size() == 1);
  }
  CHECK(house.room->census().spectators == 0);
}

TEST_CASE("what the rules say goes by one name in recordings and on the wire") {
  for (int kind = 0; kind <= static_cast<int>(rules::EventKind::kRound); ++kind) {
    const auto ruled = static_cast<rules::EventKind>(kind);
    const auto shown = static_cast<protocol::EventKind>(kind + static_cast<int>(protocol::EventKind::kGate));
    CHECK(rules::to_text(ruled) == protocol::to_text(shown));
  }
}
