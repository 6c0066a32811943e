#include "server/room/seats.h"

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

Seat unclaimed(match::PlayerId louse, const std::string& name) {
  return {louse, name, protocol::Role::kPlayer, 10 * louse, Nobody{}};
}

Seat of_session(SessionId session, match::PlayerId louse) {
  return {louse, "s" + std::to_string(session), protocol::Role::kPlayer, 0,
          SessionOccupant{session, nullptr, 0}};
}

Seat of_bot(std::uint32_t number, match::PlayerId louse) {
  return {louse, "b" + std::to_string(number), protocol::Role::kBot, 0,
          BotOccupant{number, HouseBot(number, 1)}};
}

std::vector<std::string> names(const Seats& seats) {
  std::vector<std::string> names;
  for (const protocol::PlayerEntry& entry : seats.entries()) names.push_back(entry.name);
  return names;
}

}  // namespace

TEST_CASE("seats are told unclaimed first, then the house's, then sessions by number, however they came") {
  Seats seats({unclaimed(2, "mara"), unclaimed(5, "timo")});
  seats.add(of_session(9, 11));
  seats.add(of_bot(1, 8));
  seats.add(of_session(3, 12));
  seats.add(of_bot(0, 7));
  CHECK(names(seats) == std::vector<std::string>{"mara", "timo", "b0", "b1", "s3", "s9"});
  CHECK(seats.sessions() == 2);
  std::vector<SessionId> sessions;
  seats.for_each<SessionOccupant>(
      [&](Seat&, SessionOccupant& occupant) { sessions.push_back(occupant.session); });
  CHECK(sessions == std::vector<SessionId>{3, 9});
}

TEST_CASE("an unclaimed seat is taken over once, by its name alone") {
  Seats seats({unclaimed(2, "mara"), unclaimed(5, "mara")});
  seats.add(of_session(1, 9)).name = "timo";
  CHECK_FALSE(seats.take_over("timo"));
  const auto first = seats.take_over("mara");
  REQUIRE(first);
  CHECK(first->louse == 2);
  CHECK(first->first_seq == 20);
  CHECK(seats.take_over("mara")->louse == 5);
  CHECK_FALSE(seats.take_over("mara"));
  CHECK(names(seats) == std::vector<std::string>{"timo"});
}

TEST_CASE("a session's seat is found until it is taken away") {
  Seats seats({});
  seats.add(of_session(4, 1));
  seats.add(of_session(5, 2));
  seats.add(of_bot(0, 3));
  REQUIRE(seats.find(4));
  CHECK(seats.find(4)->louse == 1);
  CHECK(seats.find(0) == nullptr);
  CHECK(seats.take_away(4)->louse == 1);
  CHECK_FALSE(seats.take_away(4));
  CHECK(seats.find(4) == nullptr);
  CHECK(seats.take_away_sessions().size() == 1);
  CHECK(seats.sessions() == 0);
  CHECK(names(seats) == std::vector<std::string>{"b0"});
}
