// What a client makes of a server that has no word, and of a room that stands still.
#include "staged_room.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;

TEST_CASE(
    "a server without a word for 1.5 s is said to be silent, and your louse stops with what is known of it") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 3), kStart));
  REQUIRE(room.on_message(protocol::MapMessage{"volcano", map->hash, map->canonical}, kStart));
  const auto acknowledge = [&](std::uint64_t tick, core::Time now) {
    REQUIRE(room.on_message(key(tick, {3, 1, 1, 3, 0, 1, 0, 5, 0}), now));
    room.update(now);
    for (const auto& sent : room.take_outgoing()) {
      const auto* input = std::get_if<protocol::Input>(&sent);
      if (input == nullptr) continue;
      protocol::Ack ack;
      ack.seq = input->seq;
      ack.you.emplace();
      ack.you->tick = tick;
      ack.you->louse.id = 3;
      ack.you->louse.position = {1.0, 1.0};
      ack.you->louse.velocity = {3.0, 0.0};
      REQUIRE(room.on_message(ack, now));
    }
  };
  const auto where = [&](core::Time now) {
    room.update(now);
    return room.lice().at(3).sample.position;
  };
  acknowledge(60, kStart);
  const core::Vec2 at = where(kStart + 200ms);
  CHECK(where(kStart + 1400ms) != at);
  CHECK_FALSE(room.silence(kStart + 1400ms));
  CHECK(room.silence(kStart + 1600ms) == Approx(1.6));
  const core::Vec2 last = where(kStart + 1600ms);
  CHECK(where(kStart + 4s) == last);
  acknowledge(63, kStart + 10s);  // it hung: no tick passed meanwhile
  CHECK_FALSE(room.silence(kStart + 10s));
  const core::Vec2 again = where(kStart + 10s + 50ms);
  CHECK(std::abs(again.x - 1.0) < 1.5);
}

TEST_CASE("in a paused room, of which frames go on to come, your louse stands") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 3), kStart));
  REQUIRE(room.on_message(protocol::MapMessage{"volcano", map->hash, map->canonical}, kStart));
  const auto frame = [&](std::uint64_t tick, core::Time now) {
    REQUIRE(room.on_message(key(tick, {3, 1, 1, 3, 0, 1, 0, 5, 0}), now));
    room.update(now);
  };
  for (auto t = 0ms; t <= 300ms; t += 50ms)
    frame(60 + static_cast<std::uint64_t>(t.count() * 60 / 1000), kStart + t);
  CHECK_FALSE(room.stands());
  room.pilot()->steering().toggle_cruise();
  for (auto t = 350ms; t <= 5000ms; t += 50ms) frame(78, kStart + t);
  CHECK(room.stands());
  CHECK_FALSE(room.silence(kStart + 5s));
  (void)room.take_outgoing();
  const core::Vec2 at = room.lice().at(3).sample.position;
  for (auto t = 5050ms; t <= 6000ms; t += 50ms) frame(78, kStart + t);
  CHECK(room.lice().at(3).sample.position == at);
  CHECK(count<protocol::Input>(room.take_outgoing()) == 0);
  frame(81, kStart + 6050ms);
  CHECK_FALSE(room.stands());
  frame(84, kStart + 6100ms);
  CHECK(count<protocol::Input>(room.take_outgoing()) > 0);
}

TEST_CASE("a room of which answers come and no frames stands still, a line that stalls does not") {
  const auto map = volcano();
  RoomView room;
  REQUIRE(room.on_message(welcome(*map, 3), kStart));
  REQUIRE(room.on_message(protocol::MapMessage{"volcano", map->hash, map->canonical}, kStart));
  const auto frame = [&](std::uint64_t tick, core::Time now) {
    REQUIRE(room.on_message(key(tick, {3, 1, 1, 3, 0, 1, 0, 5, 0}), now));
    room.update(now);
  };
  for (auto t = 0ms; t <= 1000ms; t += 50ms)
    frame(60 + static_cast<std::uint64_t>(t.count() * 60 / 1000), kStart + t);
  std::vector<protocol::Pong> answers;
  const auto run = [&](std::chrono::milliseconds from, std::chrono::milliseconds to) {
    for (auto t = from; t < to; t += 20ms) {
      room.update(kStart + t);
      for (const auto& sent : room.take_outgoing())
        if (const auto* ping = std::get_if<protocol::Ping>(&sent)) answers.push_back({ping->t});
    }
  };
  // Everything comes 600 ms late, in its order: what was said before the answer is here before it.
  run(1020ms, 1600ms);
  REQUIRE_FALSE(answers.empty());
  for (std::uint64_t tick = 123; tick <= 156; tick += 3) frame(tick, kStart + 1600ms);
  for (const protocol::Pong& pong : answers) REQUIRE(room.on_message(pong, kStart + 1600ms));
  CHECK_FALSE(room.stands());
  answers.clear();
  // The same answers, and no frames.
  run(1620ms, 2200ms);
  REQUIRE_FALSE(answers.empty());
  for (const protocol::Pong& pong : answers) REQUIRE(room.on_message(pong, kStart + 2200ms));
  CHECK(room.stands());
  frame(159, kStart + 4s);
  CHECK_FALSE(room.stands());
  REQUIRE(room.on_message(protocol::Notice{"paused", "the operator has paused this room"}, kStart + 4s));
  CHECK(room.stands());
}
