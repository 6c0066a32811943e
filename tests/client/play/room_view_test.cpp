#include "client/play/room_view.h"
#include "client/play/join_request.h"

#include <catch2/catch.hpp>

#include "client/play/modes/course_builder.h"
#include "client/play/scene_builder.h"
#include "client/play/text_game.h"
#include "shared/core/stable_hash.h"
#include "staged_room.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;

TEST_CASE("the map is asked for once and kept over a reconnection to the same map") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 1), kStart));
  REQUIRE(count<protocol::GetMap>(room.take_outgoing()) == 1);
  REQUIRE(room.on_message(protocol::MapMessage{"volcano", map->hash, map->canonical}, kStart));
  REQUIRE(room.map()->hash == map->hash);
  REQUIRE(room.pilot() != nullptr);
  room.on_lost();
  REQUIRE(room.on_message(welcome(*map, 1), kStart + 5s));
  REQUIRE(count<protocol::GetMap>(room.take_outgoing()) == 0);
  REQUIRE(room.pilot() != nullptr);
}

TEST_CASE("who comes back is told in which louse, knows its own name, and counts its inputs anew") {
  const auto map = volcano();
  RoomView room;
  protocol::Welcome message = welcome(*map, 3);
  message.name = "lin#2";
  REQUIRE(room.on_message(message, kStart));
  REQUIRE(room.on_message(protocol::MapMessage{"volcano", map->hash, map->canonical}, kStart));
  CHECK(room.notice_line().empty());
  const auto first_seq = [&](std::uint64_t tick, core::Time now) {
    REQUIRE(room.on_message(key(tick, {3, 1, 1, 0, 0, 1, 0, 5, 0}), now));
    room.update(now);
    for (const auto& sent : room.take_outgoing())
      if (const auto* input = std::get_if<protocol::Input>(&sent)) return input->seq;
    return 0u;
  };
  CHECK(first_seq(60, kStart) == 1);
  CHECK(room.lice().at(3).name == "lin#2");
  room.pilot()->steering().toggle_cruise();
  CHECK(first_seq(63, kStart + 50ms) == 2);
  room.on_lost();
  room.on_lost();  // an attempt that failed
  room.update(kStart + 1s);
  CHECK(room.lice().contains(3));  // the picture stays
  CHECK(room.take_outgoing().empty());
  message.resumed = true;
  REQUIRE(room.on_message(message, kStart + 2s));
  CHECK(room.notice_line() == "back in your louse");
  CHECK(room.roster().find(3)->name == "lin#2");  // no event tells of who comes back
  CHECK_FALSE(room.pilot()->steering().cruising());
  CHECK(first_seq(180, kStart + 2s) == 1);
  room.on_lost();
  message = welcome(*map, 4);
  REQUIRE(room.on_message(message, kStart + 40s));
  CHECK(room.notice_line() == "your louse is gone: this is a new one");
  room.on_lost();
  message.id = 0;
  REQUIRE(room.on_message(message, kStart + 50s));
  CHECK(room.notice_line() == "watching again");
}

TEST_CASE("players ask that their louse waits, and who looks on is counted every ten seconds") {
  CHECK(make_join(protocol::Role::kPlayer, "ada", "").may_resume);
  CHECK_FALSE(make_join(protocol::Role::kSpectator, "eve", "").may_resume);
  const auto map = volcano();
  RoomView room;
  protocol::Welcome message = welcome(*map, 0);
  message.room = "b";
  message.spectators = 2;
  REQUIRE(room.on_message(message, kStart));
  CHECK(room.roster().spectators() == 2);
  std::size_t asked = 0;
  for (auto t = 0s; t <= 25s; t += 1s) {
    room.update(kStart + t);
    asked += count<protocol::List>(room.take_outgoing());
  }
  CHECK(asked == 2);
  REQUIRE(room.on_message(protocol::Rooms{{{"a", "hills", 1, 0, 7}, {"b", "volcano", 1, 1, 5}}}, kStart));
  CHECK(room.roster().spectators() == 5);
}

TEST_CASE("a map that does not hash to what the server says is refused") {
  const auto map = volcano();
  RoomView room;
  protocol::Welcome message = welcome(*map, 1);
  message.map_hash ^= 1;
  REQUIRE(room.on_message(message, kStart));
  const auto taken = room.on_message(protocol::MapMessage{"volcano", map->hash, map->canonical}, kStart);
  REQUIRE_FALSE(taken);
  REQUIRE(taken.error().what.find("hash") != std::string::npos);
}

TEST_CASE("an unreadable map is an error that says what is wrong with it") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 1), kStart));
  REQUIRE_FALSE(room.on_message(protocol::MapMessage{"volcano", map->hash, "{\"name\": 3}"}, kStart));
}

TEST_CASE("a missing key is asked for at most once a second") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 0), kStart));
  static_cast<void>(room.take_outgoing());
  protocol::Frame delta = key(63, {1, 0, 0, 0, 0, 1, 0, 0, 0});
  delta.is_key = false;
  delta.base = 60;
  std::size_t asked = 0;
  for (auto t = 0ms; t < 2500ms; t += 50ms) {
    delta.tick += 3;
    REQUIRE(room.on_message(delta, kStart + t));
    asked += count<protocol::Resync>(room.take_outgoing());
  }
  REQUIRE(asked == 3);
}

TEST_CASE("lice have the names of welcome and of events, one that left keeps none") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 0), kStart));
  protocol::Event joined;
  joined.id = 3;
  joined.name = "lin";
  REQUIRE(room.on_message(joined, kStart));
  REQUIRE(room.on_message(
      key(60, {1, 1, 1, 0, 0, 1, 0, 5, 0, 2, 2, 2, 0, 0, 1, 0, 9, 0, 3, 3, 3, 0, 0, 1, 0, 7, 0}), kStart));
  room.update(kStart + 10ms);
  REQUIRE(room.lice().at(1).name == "ada");
  REQUIRE(room.lice().at(2).is_bot);
  REQUIRE(room.lice().at(3).name == "lin");
  REQUIRE(room.roster().chat().back().text == "lin joined");

  const auto scores = score_rows(room.sight());
  REQUIRE(scores.size() == 3);
  REQUIRE(scores[0].name == "gauss");
  REQUIRE(scores[1].name == "lin");
  REQUIRE(followed(room.sight(), 0) == 2);
  REQUIRE(followed(room.sight(), 3) == 3);
  REQUIRE(next_louse(room.sight(), 3) == 1);
}

TEST_CASE("a ping is sent every second and its answer is the round trip") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 0), kStart));
  static_cast<void>(room.take_outgoing());
  std::vector<protocol::ClientMessage> sent;
  for (auto t = 0ms; t < 3000ms; t += 33ms) {
    room.update(kStart + t);
    for (const auto& message : room.take_outgoing()) sent.push_back(message);
  }
  REQUIRE(count<protocol::Ping>(sent) == 3);
  const auto ping = std::get<protocol::Ping>(sent.front());
  REQUIRE(room.on_message(protocol::Pong{ping.t}, kStart + 150ms));
  REQUIRE(*room.rtt_seconds() == Approx(0.15));
  REQUIRE(room.on_message(protocol::Pong{0}, kStart + 160ms));
  REQUIRE(*room.rtt_seconds() == Approx(0.15));
}

TEST_CASE("what the server pings is answered with the same number") {
  RoomView room;
  REQUIRE(room.on_message(protocol::Ping{42}, kStart));
  const auto sent = room.take_outgoing();
  REQUIRE(sent.size() == 1);
  REQUIRE(std::get<protocol::Pong>(sent[0]).t == 42);
}

TEST_CASE("an error of the server is shown for a while") {
  RoomView room;
  REQUIRE(room.on_message(protocol::ErrorMessage{"rate_limited", "too fast", false, {}}, kStart));
  room.update(kStart + 1s);
  REQUIRE(room.notice_line() == "too fast");
  room.update(kStart + 5s);
  REQUIRE(room.notice_line().empty());
}

TEST_CASE("the chat keeps its newest lines and no more") {
  Roster roster;
  for (int i = 0; i < 1000; ++i) roster.note("line " + std::to_string(i));
  REQUIRE(roster.chat().size() == Roster::kLines);
  REQUIRE(roster.chat().back().text == "line 999");
  REQUIRE(roster.lines_said() == 1000);
}

TEST_CASE("a louse is read out with place, height, speed and slope") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 0), kStart));
  REQUIRE(room.on_message(protocol::MapMessage{"volcano", map->hash, map->canonical}, kStart));
  REQUIRE(room.on_message(key(60, {1, 3, -4, 0, 2, 1, 0, 41, 0}), kStart));
  room.update(kStart);
  const auto lines = words::room(room);
  REQUIRE(lines.size() == 1);
  REQUIRE(lines[0].starts_with("ada: 3.0 m east, 4.0 m south, height "));
  REQUIRE(lines[0].find("m/s north, slope ") != std::string::npos);
  REQUIRE(lines[0].ends_with("travelled 41 m, number 1"));
}

TEST_CASE("the eight winds are named after their direction") {
  REQUIRE(words::compass({1, 0}) == "east");
  REQUIRE(words::compass({1, 1}) == "north-east");
  REQUIRE(words::compass({-1, 0}) == "west");
  REQUIRE(words::compass({-1, -0.001}) == "west");
  REQUIRE(words::compass({0, -1}) == "south");
}

TEST_CASE(
    "on a map of which there is an overview alone, the own louse is drawn from frames, and still driven") {
  const auto definition = R"({"name":"alps","terrain":{"file":"alps.flt"},"physics":{"thrust_max":4},)"
                          R"("spawns":[{"position":[500,0]}]})";
  protocol::Welcome message = welcome(*volcano(), 1);
  message.map_hash = core::stable_hash(definition);
  message.extent = {-500, -500, 500, 500};
  const terrain::HeightGrid overview{5, 5, -500, -500, 250, 250, std::vector<double>(25, 3.0)};
  RoomView room;
  REQUIRE(room.on_message(message, kStart));
  REQUIRE(
      room.on_message(protocol::MapMessage{"alps", message.map_hash, definition, true, overview}, kStart));
  REQUIRE(room.map()->detail == map::Detail::kOverview);
  REQUIRE(room.pilot() != nullptr);
  static_cast<void>(room.take_outgoing());
  std::size_t asked = 0;
  for (std::uint64_t tick = 600; tick < 720; tick += 3) {
    const core::Time now = kStart + std::chrono::microseconds((tick - 600) * 16667);
    REQUIRE(room.on_message(
        key(tick, {1, 7.0 + 0.01 * static_cast<double>(tick - 600), -4.0, 0.6, 0.0, 1, 0, 0, 0}), now));
    room.update(now);
    for (const auto& out : room.take_outgoing()) {
      const auto* input = std::get_if<protocol::Input>(&out);
      if (input == nullptr) continue;
      ++asked;
      protocol::Ack ack{input->seq, input->tick.value_or(tick), 9000, false, false,
                        false,      protocol::ExactState{}};
      ack.you->tick = ack.tick + 1;
      ack.you->louse.id = 1;
      ack.you->louse.position = {400.0, 400.0};  // nothing is drawn from it
      ack.you->louse.heading = {1.0, 0.0};
      REQUIRE(room.on_message(ack, now));
    }
  }
  CHECK(asked == 1);  // for the heading, and never again for a state
  REQUIRE(room.lice().contains(1));
  CHECK_FALSE(room.pilot()->sample());
  CHECK(room.lice().at(1).sample.position.x == Approx(8.11).margin(0.1));
  room.pilot()->steering().push(kStart + 3s);
  room.update(kStart + 3s);
  CHECK(count<protocol::Input>(room.take_outgoing()) == 1);
}
