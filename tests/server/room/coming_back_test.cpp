// A louse that waits for its player.
#include <catch2/catch.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/server/room/house.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

namespace {

struct Waiting : House {
  explicit Waiting(std::uint32_t places = 8) : House(settings(places)) {
    room->start([] {});
  }

  std::shared_ptr<Guest> come(SessionId session, const std::string& resume = {}) {
    protocol::Join wanted = named("ann");
    wanted.may_resume = true;
    wanted.resume = resume;
    return join(session, wanted);
  }
  void push(SessionId session, std::uint32_t seq, std::optional<std::uint64_t> at = {}) {
    protocol::Input input;
    input.seq = seq;
    input.thrust.value = {1.0, 0.0};
    input.tick = at;
    door->submit(session, input, timekeeper.now());
  }
  /// As a spectator sees it: of louse `id` its push along the heading; nothing where there is no such louse.
  std::optional<int> thrust_of(std::uint32_t id) {
    protocol::Join eye = named("eye", protocol::Role::kSpectator);
    eye.fields = {protocol::Column::kId, protocol::Column::kTx};
    eye.format = protocol::Format::kExact;
    const auto guest = join(1000, eye);
    door->leave(1000, Parting::kLeft);
    settle();
    const std::string row = "[" + std::to_string(id) + ",";
    for (auto frame = guest->frames.rbegin(); frame != guest->frames.rend(); ++frame) {
      const std::size_t at = frame->text->find(row);
      if (at != std::string::npos) return std::stoi(frame->text->substr(at + row.size()));
    }
    return std::nullopt;
  }
  void wait(std::chrono::seconds time) { tick(static_cast<int>(time.count()) * 60); }
};

}  // namespace

TEST_CASE("who asked for it comes back to its louse, whose thrust had ended, and counts inputs anew") {
  Waiting house;
  const auto ann = house.come(1);
  const protocol::Welcome first = ann->welcomes.at(0);
  CHECK(first.resume_token.size() == 32);
  CHECK_FALSE(first.resumed);
  house.push(1, 40);
  house.push(1, 41, 100);
  house.tick(3);
  CHECK(house.thrust_of(first.id) == 1);
  house.door->leave(1, Parting::kLost);
  house.tick(3);
  CHECK(house.thrust_of(first.id) == 0);
  house.wait(std::chrono::seconds(10));
  CHECK(house.thrust_of(first.id) == 0);  // also of what it had asked for ahead
  const auto back = house.come(2, first.resume_token);
  REQUIRE(back->welcomes.size() == 1);
  CHECK(back->welcomes[0].id == first.id);
  CHECK(back->welcomes[0].resumed);
  CHECK(back->welcomes[0].name == "ann");
  CHECK(back->welcomes[0].resume_token == first.resume_token);
  CHECK_FALSE(back->frames.empty());
  house.push(2, 1);
  house.tick(3);
  CHECK(house.thrust_of(first.id) == 1);
  REQUIRE_FALSE(back->answers.empty());
  CHECK(std::get<protocol::Ack>(back->answers.back()).seq == 1);
}

TEST_CASE("a louse waits for as long as declared, and a token that is too late or a guess gets a new one") {
  Waiting house;
  const auto ann = house.come(1);
  const std::string token = ann->welcomes.at(0).resume_token;
  const auto bob = house.join(5, named("bob"));
  house.door->leave(1, Parting::kLost);
  house.wait(std::chrono::seconds(29));
  CHECK(house.thrust_of(ann->welcomes[0].id));
  CHECK(bob->lines.back().find("\"left\"") == std::string::npos);
  house.wait(std::chrono::seconds(2));
  CHECK_FALSE(house.thrust_of(ann->welcomes[0].id));
  CHECK(bob->lines.back().find("\"left\"") != std::string::npos);
  SessionId next = 10;
  for (const std::string& wrong : {token, std::string(32, '0'), std::string("x")}) {
    const auto late = house.come(next++, wrong);
    CHECK_FALSE(late->welcomes.at(0).resumed);
    CHECK(late->welcomes[0].id != ann->welcomes[0].id);
    CHECK(late->welcomes[0].resume_token != token);
  }
}

TEST_CASE("who comes back while the old connection looks alive takes its place, and that hears why") {
  Waiting house;
  const auto old = house.come(1);
  const auto back = house.come(2, old->welcomes.at(0).resume_token);
  CHECK(back->welcomes.at(0).id == old->welcomes[0].id);
  REQUIRE(old->byes.size() == 1);
  CHECK(old->byes[0].code == "replaced");
  house.door->leave(1, Parting::kLost);
  house.push(2, 1);
  house.tick(3);
  CHECK(house.thrust_of(old->welcomes[0].id) == 1);
  CHECK(house.room->census().players == 1);
}

TEST_CASE("who never asked to come back, and who left, is gone") {
  Waiting house;
  const auto plain = house.join(1, named("bob"));
  CHECK(plain->welcomes.at(0).resume_token.empty());
  house.door->leave(1, Parting::kLost);
  const auto ann = house.come(2);
  house.door->leave(2, Parting::kLeft);
  house.tick(3);
  CHECK_FALSE(house.thrust_of(plain->welcomes[0].id));
  CHECK_FALSE(house.thrust_of(ann->welcomes.at(0).id));
  CHECK(house.room->census().players == 0);
}

TEST_CASE("a louse that waits gives way to a player where the room is full") {
  Waiting house(1);
  const auto ann = house.come(1);
  house.door->leave(1, Parting::kLost);
  house.tick(3);
  const auto bob = house.join(2, named("bob"));
  REQUIRE(bob->welcomes.size() == 1);
  house.tick(3);
  CHECK_FALSE(house.thrust_of(ann->welcomes.at(0).id));
  CHECK(house.come(3, ann->welcomes[0].resume_token)->refusals.size() == 1);
}

TEST_CASE("of one address few lice wait, the last ones") {
  Waiting house(64);
  house.address_of = [](SessionId) { return AddressId{7}; };
  std::vector<std::uint32_t> ids;
  for (SessionId session = 1; session <= Members::kMostVacantOfAddress + 3; ++session) {
    ids.push_back(house.come(session)->welcomes.at(0).id);
    house.door->leave(session, Parting::kLost);
    house.tick();
  }
  house.tick(3);
  for (std::size_t k = 0; k < ids.size(); ++k) CHECK(house.thrust_of(ids[k]).has_value() == (k >= 3));
}

TEST_CASE("a player that says nothing any more stops, and goes on when it speaks again") {
  Waiting house;
  const auto ann = house.come(1);
  house.push(1, 1);
  house.push(1, 2, 60);
  house.tick(3);
  house.door->vacate(1);
  house.tick(90);
  CHECK(house.thrust_of(ann->welcomes.at(0).id) == 0);
  REQUIRE(ann->answers.size() == 2);
  CHECK(std::get<protocol::Ack>(ann->answers[1]).dropped);
  CHECK_FALSE(std::get<protocol::Ack>(ann->answers[1]).you);
  house.push(1, 3);
  house.tick(3);
  CHECK(house.thrust_of(ann->welcomes[0].id) == 1);
}
