#include "server/room/seats.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

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
  CHECK(first->next_seq == 20);
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

TEST_CASE("names are one of a kind, however many ask for one") {
  Seats seats({unclaimed(2, "mara")});
  CHECK(seats.free_name("ann", 1) == "ann");
  CHECK(seats.free_name("mara", 1) == "mara#2");
  for (SessionId session = 1; session <= 50; ++session) {
    Seat seat = of_session(session, static_cast<match::PlayerId>(100 + session));
    seat.name = seats.free_name("mara", session);
    seats.add(std::move(seat));
  }
  std::vector<std::string> all = names(seats);
  std::sort(all.begin(), all.end());
  CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
  const std::string longest(protocol::kMaxNameBytes, 'x');
  Seat seat = of_session(99, 999);
  seat.name = longest;
  seats.add(std::move(seat));
  const std::string other = seats.free_name(longest, 1);
  CHECK(other == longest.substr(0, longest.size() - 2) + "#2");
  seats.take_away(99);
  CHECK(seats.free_name(longest, 1) == longest);
}

TEST_CASE("a seat is taken back by its token alone, of a session or vacant, once") {
  Seats seats({});
  const ResumeToken token{1, 2};
  Seat held = of_session(4, 1);
  held.token = token;
  held.claim = digest_of(token);
  seats.add(std::move(held));
  CHECK_FALSE(seats.take_back({2, 1}));
  Seat back = seats.take_back(digest_of(token)).value();
  CHECK(back.louse == 1);
  CHECK_FALSE(seats.take_back(digest_of(token)));
  back.occupant = Vacant{100};
  seats.add(std::move(back));
  CHECK(seats.sessions() == 0);
  CHECK(seats.vacant() == 1);
  CHECK(names(seats).size() == 1);
  CHECK(seats.vacant_seats([](const Seat&) { return true; }).oldest == 1);
  CHECK(seats.vacant_seats([](const Seat&) { return false; }).count == 0);
  CHECK(seats.take_back(digest_of(token))->louse == 1);
  CHECK(seats.vacant() == 0);
}

TEST_CASE("a token is 32 hex digits, and no two are alike") {
  const ResumeToken token = make_resume_token();
  CHECK(token != make_resume_token());
  CHECK(resume_token_from(to_text(token)) == token);
  CHECK(to_text({0x1, 0xabcdef}) == "00000000000000010000000000abcdef");
  for (const char* bad : {"", "1", "0000000000000001000000000000000g", "-0000000000000010000000000abcdef",
                          "000000000000000100000000000abcdef0"})
    CHECK_FALSE(resume_token_from(bad));
}
