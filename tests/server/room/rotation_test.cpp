// A room that plays one game after the other.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/server/room/turning.h"

namespace woodlouse::server::test {

TEST_CASE("most of the players vote, and everybody is in the next game") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann")), ben = house.join(2, named("ben"));
  const auto bot = house.join(3, named("r2", protocol::Role::kBot));
  const auto eve = house.join(4, named("eve", protocol::Role::kSpectator));
  house.tick(3);
  CHECK(ann->welcomes.at(0).mode == "hill");
  CHECK(ann->welcomes.at(0).map_name == "table");

  house.say(1, protocol::Skip{});
  house.say(1, protocol::Skip{});  // one voice each
  house.say(3, protocol::Skip{});
  CHECK(code_of(bot->answers.back()) == "no_vote");
  CHECK(has(eve->lines,
            R"("kind":"skip","id":)" + std::to_string(ann->welcomes.at(0).id) + R"(,"name":"ann")"));
  CHECK(has(eve->lines, R"("votes":1,"needed":2)"));
  house.tick(3);
  CHECK(turns.asked == 0);
  house.say(2, protocol::Skip{});
  house.tick(2);
  REQUIRE(turns.asked == 1);
  const std::size_t before = ann->frames.size();
  house.tick(6);
  CHECK(ann->frames.size() == before + 2);  // the game goes on until the next one is there
  turns.make();
  house.tick();

  CHECK(seen.calls == std::vector<std::string>{"begin 1", "begin 2", "finish 1"});
  CHECK(house.room->census().map == "volcano");
  CHECK(house.room->census().players == 2);
  CHECK(house.room->census().bots == 3);
  for (const auto& guest : {ann, ben, bot, eve}) {
    REQUIRE(guest->welcomes.size() == 2);
    const protocol::Welcome& welcome = guest->welcomes[1];
    CHECK(welcome.mode == "roam");
    CHECK(welcome.rules.empty());
    CHECK(welcome.map_name == "volcano");
    CHECK(welcome.tick == 0);
    CHECK_FALSE(welcome.resumed);
    CHECK(welcome.players.size() == 5);
    CHECK(welcome.spectators == 1);
    CHECK(welcome.name == guest->welcomes[0].name);
    CHECK(welcome.fields == guest->welcomes[0].fields);
    CHECK((welcome.id == 0) == (guest == eve));
    // What comes behind the welcome is of the new game: a key first.
    REQUIRE(guest->frames.size() > guest->frames_at_welcome[1]);
    CHECK(guest->frames[guest->frames_at_welcome[1]].kind == FrameKind::kKey);
    for (std::size_t k = guest->frames_at_welcome[1]; k < guest->frames.size(); ++k)
      CHECK(guest->frames[k].tick < 10);
    CHECK_FALSE(has(guest->lines, "late words"));
    CHECK(std::none_of(guest->answers.begin(), guest->answers.end(),
                       [](const protocol::ServerMessage& message) {
                         return std::holds_alternative<protocol::Notice>(message);
                       }));
  }
  // Nobody hears "joined" of it, and the count of events goes on.
  CHECK_FALSE(has(ben->lines, R"("n":1,"tick":0)"));
  house.say(1, protocol::Chat{"new ground"});
  CHECK(has(ben->lines, "new ground"));
  // Votes are of a game.
  house.say(2, protocol::Skip{});
  house.tick(3);
  CHECK(turns.asked == 1);
}

TEST_CASE("what was counted beside a game is never taken back, however long that takes to finish") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  house.join(1, named("ann"));
  house.say(1, protocol::Skip{});
  house.next_game();
  REQUIRE(seen.unfinished.size() == 1);
  house.tick(61);
  REQUIRE(house.room->figures()->shadow);
  CHECK(house.room->figures()->shadow->ticks == 2);  // one of each game
  std::exchange(seen.unfinished, {}).front()();
  house.tick(61);
  CHECK(house.room->figures()->shadow->ticks == 2);
}

TEST_CASE("a player's own count of inputs goes on in the next game, where he has a louse at rest") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann"));
  house.push(1, 40);
  house.tick(2);
  REQUIRE(last_ack(*ann));
  CHECK(last_ack(*ann)->seq == 40);
  house.say(1, protocol::Skip{});
  house.next_game();
  REQUIRE(ann->welcomes.size() == 2);
  const auto later = house.join(9, named("late"));
  house.tick(3);
  house.push(1, 40);
  CHECK(code_of(ann->answers.back()) == "stale_seq");
  house.push(1, 41);
  house.tick(2);
  CHECK(last_ack(*ann)->seq == 41);
  REQUIRE(last_ack(*ann)->you);
  CHECK(last_ack(*ann)->you->louse.id == ann->welcomes[1].id);
  CHECK(later->welcomes.at(0).map_name == "volcano");
}

TEST_CASE("a game is over after its rounds, and one without rules after as much time") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns, 2);
  const auto ann = house.join(1, named("ann"));
  house.say(1, protocol::Skip{});
  house.next_game();
  REQUIRE(ann->welcomes.at(1).mode == "roam");
  house.tick(2 * 5 * 60 * 60 - 10);
  CHECK(turns.asked == 1);
  house.tick(20);
  REQUIRE(turns.asked == 2);
  turns.make();
  house.tick();
  REQUIRE(ann->welcomes.size() == 3);
  REQUIRE(ann->welcomes[2].mode == "hill");
  // The two bots end a round of a hill at the latest when its time is over.
  int ticks = 0;
  for (; turns.asked == 2 && ticks < 4 * 1000 * 60; ticks += 60) house.tick(60);
  CHECK(turns.asked == 3);
  CHECK(has(ann->lines, R"("round":2)"));
  CHECK(has(ann->lines, R"("phase":"podium")"));
}

TEST_CASE("whose connection is broken when games change comes back to the louse that waits for him there") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann"));
  protocol::Join wanted = named("ben");
  wanted.may_resume = true;
  const auto ben = house.join(2, wanted);
  house.tick(120);
  house.door->leave(2, Parting::kLost);
  house.tick(60);
  house.say(1, protocol::Skip{});  // of those who are here it is the most
  house.next_game();
  REQUIRE(ann->welcomes.size() == 2);
  CHECK(ann->welcomes[1].players.size() == 4);
  wanted.resume = ben->welcomes.at(0).resume_token;
  house.tick(60);
  const auto back = house.join(3, wanted);
  REQUIRE(back->welcomes.size() == 1);
  CHECK(back->welcomes[0].resumed);
  CHECK(back->welcomes[0].map_name == "volcano");
  CHECK(back->welcomes[0].resume_token == wanted.resume);
  // He waits no longer than he would have.
  house.door->leave(3, Parting::kLost);
  house.tick(29 * 60);
  const auto census = house.room->census();
  CHECK(census.players == 2);
  house.tick(2 * 60);
  CHECK(house.room->census().players == 1);
}

TEST_CASE("a room stops when the watchers of all its games are done, and what stands outside stays") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann"));
  house.say(1, protocol::Skip{});
  house.next_game();
  bool has_stopped = false;
  house.room->stop({"shutdown", "over", false}, "over", [&] { has_stopped = true; });
  house.settle();
  REQUIRE(ann->byes.size() == 1);
  CHECK(seen.calls == std::vector<std::string>{"begin 1", "begin 2", "finish 1", "finish 2"});
  const auto finish = [&] {
    const auto done = seen.unfinished.front();
    seen.unfinished.erase(seen.unfinished.begin());
    done();
    house.settle();
  };
  REQUIRE(seen.unfinished.size() == 2);
  finish();
  CHECK_FALSE(has_stopped);
  finish();
  CHECK(has_stopped);
}

}  // namespace woodlouse::server::test
