// Votes for a room's next game.
#include <catch2/catch.hpp>

#include <string>

#include "tests/server/room/turning.h"

namespace woodlouse::server::test {

TEST_CASE("who has asked to leave is let go when games change, and who leaves counts no more") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann")), ben = house.join(2, named("ben"));
  const auto dan = house.join(3, named("dan"));
  house.tick(3);
  protocol::Input ahead;
  ahead.seq = 1;
  ahead.thrust.value = {1.0, 0.0};
  ahead.tick = 60;
  house.say(3, ahead);
  house.say(3, protocol::Leave{});
  house.tick();
  CHECK(dan->times_let_go == 0);
  house.say(1, protocol::Skip{});
  house.say(2, protocol::Skip{});
  house.next_game();
  CHECK(dan->times_let_go == 1);
  house.door->leave(3, Parting::kLeft);
  house.settle();
  house.say(1, protocol::Skip{});
  house.door->leave(1, Parting::kLeft);  // his vote goes with him
  house.tick(3);
  CHECK(turns.asked == 1);
  house.say(2, protocol::Skip{});
  house.tick(2);
  CHECK(turns.asked == 2);
}

TEST_CASE("who connects often has one vote with all of them") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  house.address_of = [](SessionId session) { return session < 6 ? 1 : session; };
  for (SessionId session = 1; session <= 7; ++session) house.join(session);
  for (SessionId session = 1; session <= 5; ++session) house.say(session, protocol::Skip{});
  house.tick(3);
  CHECK(turns.asked == 0);
  const auto late = house.join(8);
  house.say(2, protocol::Skip{});
  CHECK_FALSE(has(late->lines, R"("kind":"skip")"));  // he has voted
  house.say(6, protocol::Skip{});
  CHECK(has(late->lines, R"("votes":2,"needed":3)"));
  house.tick(3);
  CHECK(turns.asked == 0);
  house.say(8, protocol::Skip{});
  house.tick(2);
  CHECK(turns.asked == 1);
}

TEST_CASE("who comes back while his old connection is open votes anew, from where he is") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann")), dan = house.join(2, named("dan"));
  protocol::Join wanted = named("ben");
  wanted.may_resume = true;
  const auto ben = house.join(3, wanted);
  house.say(3, protocol::Skip{});
  wanted.resume = ben->welcomes.at(0).resume_token;
  const auto back = house.join(4, wanted);
  REQUIRE(back->welcomes.at(0).resumed);
  house.tick(2);
  house.say(1, protocol::Skip{});
  CHECK(has(dan->lines, R"("votes":1,"needed":2)"));
  house.door->leave(3, Parting::kLost);
  house.tick(2);
  CHECK(turns.asked == 0);
  house.say(4, protocol::Skip{});
  house.tick(2);
  CHECK(turns.asked == 1);
  CHECK(ann->welcomes.size() == 1);
}

TEST_CASE("a room of one game alone has nothing to vote about") {
  House house(settings(8));
  house.room->start([] {});
  const auto ann = house.join(1, named("ann"));
  house.door->submit(1, protocol::Skip{}, house.timekeeper.now());
  house.settle();
  CHECK(code_of(ann->answers.back()) == "no_vote");
}

}  // namespace woodlouse::server::test
