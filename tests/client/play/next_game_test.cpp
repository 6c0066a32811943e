// A room that plays one game after the other, as its client sees it.
#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "client/play/room_view.h"
#include "client/play/roster.h"
#include "client/play/spoken_words.h"
#include "staged_room.h"

namespace woodlouse::client {
namespace {

using namespace std::chrono_literals;

/// As louse 3; what the welcome was.
protocol::Welcome join_hill(RoomView& room, std::uint32_t tick_hz) {
  auto loaded = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/table.json");
  REQUIRE(loaded);
  const map::Map& map = **loaded;
  protocol::Welcome message = welcome(map, 3);
  message.mode = "hill";
  message.tick_hz = tick_hz;
  REQUIRE(room.on_message(message, kStart));
  REQUIRE(room.on_message(protocol::MapMessage{map.definition.name, map.hash, map.canonical}, kStart));
  return message;
}

}  // namespace

TEST_CASE("a second welcome is another game of the room: its map is asked for, and inputs are counted on") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 1), kStart));
  protocol::MapMessage whole{map->definition.name, map->hash, map->canonical};
  REQUIRE(room.on_message(whole, kStart));
  REQUIRE(room.pilot() != nullptr);
  std::vector<double> row(wanted_columns().size(), 0.0);
  row[0] = 1;
  for (std::uint64_t k = 0; k < 40; ++k) {
    const core::Time now = kStart + 50ms * k;
    REQUIRE(room.on_message(key(3 * k, row), now));
    room.pilot()->steering().push(now);
    room.update(now);
  }
  const auto sent = room.take_outgoing();
  REQUIRE(count<protocol::Input>(sent) > 1);
  const std::uint32_t last = room.pilot()->last_seq();
  REQUIRE(last > 1);

  const core::Time later = kStart + 3s;
  protocol::Welcome next = welcome(*map, 7);
  next.map_name = "elsewhere";
  next.map_hash = map->hash + 1;
  next.mode = "race";
  REQUIRE(room.on_message(next, later));
  CHECK(room.notice_line() == "now: race on elsewhere");
  CHECK(room.pilot() == nullptr);
  CHECK(room.lice().empty());
  CHECK(count<protocol::GetMap>(room.take_outgoing()) == 1);
  // And one more before the map has come, on the ground that was here.
  next = welcome(*map, 8);
  REQUIRE(room.on_message(next, later));
  CHECK(count<protocol::GetMap>(room.take_outgoing()) == 1);
  REQUIRE(room.on_message(whole, later));
  REQUIRE(room.pilot() != nullptr);
  CHECK(room.pilot()->id() == 8);
  CHECK(room.pilot()->last_seq() == last);
  room.on_lost();
  REQUIRE(room.on_message(welcome(*map, 9), later + 1s));
  CHECK(room.pilot()->last_seq() == 0);
}

TEST_CASE("/skip is a vote and no chat, and the chat tells of others' votes") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 1), kStart));
  static_cast<void>(room.take_outgoing());
  room.say("/skip");
  room.say("/skip it");
  const auto sent = room.take_outgoing();
  CHECK(count<protocol::Skip>(sent) == 1);
  CHECK(count<protocol::Chat>(sent) == 1);
  protocol::Event event;
  event.kind = protocol::EventKind::kSkip;
  event.name = "gauss";
  event.values = {1, 3};
  CHECK(describe(event) == "gauss votes for the next game (/skip): 1 of 3");
}

TEST_CASE("who fell off a hill is not there until it is back, and cruises no more") {
  RoomView room;
  join_hill(room, 60);
  const auto shown = [&](std::uint64_t tick, std::vector<double> lice, core::Time now) {
    protocol::Frame frame = key(tick, std::move(lice));
    frame.game.emplace();
    frame.game->phase = protocol::GamePhase::kPlay;
    REQUIRE(room.on_message(frame, now));
  };
  shown(60, {3, 1, 1, 0, 0, 1, 0, 5, 0}, kStart);
  protocol::Ack ack;
  ack.tick = 60;
  ack.you.emplace();
  ack.you->louse.id = 3;
  REQUIRE(room.on_message(ack, kStart));
  room.update(kStart + 10ms);
  REQUIRE(room.pilot()->sample());
  REQUIRE(room.lice().contains(3));
  room.pilot()->steering().toggle_cruise();

  protocol::Event event;
  event.kind = protocol::EventKind::kFell;
  event.id = 3;
  event.name = "ada";
  REQUIRE(room.on_message(event, kStart + 50ms));
  CHECK_FALSE(room.pilot()->steering().cruising());
  CHECK(room.roster().chat().back().text == "you fell off");
  shown(63, {}, kStart + 60ms);
  room.update(kStart + 70ms);
  CHECK_FALSE(room.lice().contains(3));
  REQUIRE_FALSE(words::goal(room).empty());
  CHECK(words::goal(room).back().find("out: back at a spawn soon") != std::string::npos);

  event.kind = protocol::EventKind::kReturned;
  REQUIRE(room.on_message(event, kStart + 90ms));
  CHECK_FALSE(room.pilot()->sample());  // the next ack says where
  shown(66, {3, 4, 4, 0, 0, 1, 0, 5, 0}, kStart + 110ms);
  room.update(kStart + 120ms);
  CHECK(room.lice().contains(3));
}

TEST_CASE("who loses the line sees what the rules showed last, and where the louse headed") {
  RoomView room;
  protocol::Welcome message = join_hill(room, 30);
  protocol::Frame frame = key(60, {3, 1, 1, 0, 0, 1, 0, 5, 0});
  frame.game.emplace();
  frame.game->phase = protocol::GamePhase::kPlay;
  REQUIRE(room.on_message(frame, kStart));
  room.update(kStart);
  REQUIRE(room.sight().ruling.game != nullptr);
  const double tick = room.sight().ruling.tick;
  const core::Vec2 heading = room.pilot()->steering().heading();
  room.on_lost();
  room.on_lost();                                // an attempt that failed
  REQUIRE(room.on_message(frame, kStart + 1s));  // too late: of nobody any more
  room.update(kStart + 2s);
  REQUIRE(room.sight().ruling.game != nullptr);
  CHECK(room.sight().ruling.mode == state::Mode::kHill);
  CHECK(room.sight().ruling.tick == tick);
  CHECK(room.sight().ruling.tick_hz == 30);
  CHECK(room.lice().at(3).sample.heading.x == heading.x);
  CHECK(room.lice().at(3).sample.heading.y == heading.y);

  // Back in: until the next frame comes that still holds; in another game, or after such a frame, it does
  // not.
  message.resumed = true;
  REQUIRE(room.on_message(message, kStart + 3s));
  room.update(kStart + 3s);
  REQUIRE(room.sight().ruling.game != nullptr);
  CHECK(room.sight().ruling.tick == tick);
  frame.tick = frame.base = 63;
  frame.game->phase = protocol::GamePhase::kPodium;
  REQUIRE(room.on_message(frame, kStart + 3s));
  REQUIRE(room.sight().ruling.game != nullptr);
  CHECK(room.sight().ruling.game->phase == protocol::GamePhase::kPodium);
  message.mode = "roam";
  REQUIRE(room.on_message(message, kStart + 4s));
  CHECK(room.sight().ruling.game == nullptr);
}

}  // namespace woodlouse::client
