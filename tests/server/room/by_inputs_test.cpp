// Who watches a room by inputs.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "shared/follow/follower.h"
#include "tests/server/room/turning.h"

namespace woodlouse::server::test {
namespace {

protocol::Join by_inputs(const std::string& name) {
  protocol::Join join;
  join.role = protocol::Role::kSpectator;
  join.stream = protocol::Stream::kInputs;
  join.name = name;
  return join;
}

/// Re-runs what the guest has got since, and gives how many steps that proved.
/// due: the next step, of one who has had all before; 0: a keyframe comes first.
std::uint64_t follow(follow::Follower& follower, Guest& guest, std::uint64_t due = 0) {
  const std::uint64_t before = follower.proven();
  for (const StreamPart& part : guest.parts) {
    if (!part.lines) continue;
    if (part.kind == StreamPart::Kind::kSteps && part.first < due) continue;  // as a session passes it over
    REQUIRE((part.kind != StreamPart::Kind::kSteps || part.first == due || due == 0));
    if (part.kind == StreamPart::Kind::kSteps && due == 0) continue;
    due = part.next;
    const std::string& text = *part.lines;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
      end = text.find('\n', at);
      const bool is_taken = follower.take(std::string_view(text).substr(at, end - at));
      INFO((is_taken ? std::string() : follower.difference()->what));
      REQUIRE(is_taken);
    }
  }
  guest.parts.clear();
  return follower.proven() - before;
}

void say(House& house, SessionId session, protocol::ClientMessage message) {
  house.door->submit(session, std::move(message), house.timekeeper.now());
  house.settle();
}

}  // namespace

TEST_CASE("a watcher by inputs gets header, keyframe and every step, and no frame") {
  House house(settings(8));
  house.room->start([] {});
  const auto ann = house.join(1);
  house.tick(5);
  const auto eve = house.join(2, by_inputs("eve"));
  REQUIRE(eve->welcomes.size() == 1);
  CHECK(eve->welcomes[0].stream == protocol::Stream::kInputs);
  CHECK(eve->welcomes[0].state_hz == 10);
  CHECK(eve->divisor == 2);
  CHECK(ann->welcomes[0].stream == protocol::Stream::kFrames);
  protocol::Input push;
  push.seq = 1;
  push.thrust.value = {1.0, 0.0};
  say(house, 1, push);
  house.tick(60);
  CHECK(eve->frames.empty());
  CHECK(ann->parts.empty());
  CHECK_FALSE(ann->frames.empty());
  REQUIRE(eve->parts.size() > 10);
  CHECK(eve->parts[0].kind == StreamPart::Kind::kHeader);
  CHECK(eve->parts[1].kind == StreamPart::Kind::kKeyframe);
  follow::Follower follower("test");
  CHECK(follow(follower, *eve) >= 56);
  CHECK(follower.gaps() == 0);
}

TEST_CASE("in a room that stands still who watches by inputs has every step, and who comes has a keyframe") {
  House house(settings(8));
  house.room->start([] {});
  house.join(1);
  const auto eve = house.join(2, by_inputs("eve"));
  house.tick(8);
  std::uint64_t tick = 0;
  const auto done = [&tick](core::Expected<std::uint64_t> at) { tick = at.value(); };
  house.room->pause(done);
  house.settle();
  CHECK(eve->parts.back().is_last);
  follow::Follower follower("test");
  follow(follower, *eve);
  CHECK(follower.match()->tick() == tick);
  for (int k = 0; k < 4; ++k) {
    house.room->step(1, done);
    house.tick(3);
    CHECK(follow(follower, *eve, tick - 1) == 1);
    CHECK(follower.match()->tick() == tick);
  }
  const auto late = house.join(3, by_inputs("late"));
  REQUIRE(late->parts.size() >= 2);
  follow::Follower again("test");
  follow(again, *late);
  CHECK(again.match()->tick() == tick);
  say(house, 2, protocol::Resync{});
  REQUIRE_FALSE(eve->parts.empty());
  CHECK(eve->parts[0].kind == StreamPart::Kind::kKeyframe);
}

TEST_CASE("more may join and leave a room that stands still than lice find place, and it is proven") {
  RoomSettings many = settings(8);
  many.limits.join_per_s_room = many.limits.join_per_s_address = 100'000;
  House house(many);
  house.room->start([] {});
  house.join(1);
  const auto eve = house.join(2, by_inputs("eve"));
  house.tick(3);
  house.room->pause([](const auto& paused) { CHECK(paused); });
  house.settle();
  std::size_t refused = 0;
  for (SessionId session = 3; session < 3 + Members::kMostPaused + 2; ++session) {
    refused += house.join(session)->refusals.size();
    house.door->leave(session, Parting::kLeft);
    house.settle();
  }
  CHECK(refused == 2);
  house.room->resume([](const auto& resumed) { CHECK(resumed); });
  house.tick(30);
  follow::Follower follower("test");
  CHECK(follow(follower, *eve) >= 24);
}

TEST_CASE("who comes a little later shares the keyframe, who comes much later has a new one") {
  House house(settings(8));
  house.room->start([] {});
  house.join(1);
  const auto eve = house.join(2, by_inputs("eve"));
  house.tick(10);
  const auto dan = house.join(3, by_inputs("dan"));
  house.tick(70);
  const auto kim = house.join(4, by_inputs("kim"));
  house.tick(10);
  const auto keyframe_of = [](const Guest& guest) { return guest.parts.at(1).lines; };
  CHECK(keyframe_of(*eve) == keyframe_of(*dan));
  CHECK_FALSE(keyframe_of(*eve) == keyframe_of(*kim));
  for (const auto& guest : {eve, dan, kim}) {
    follow::Follower follower("test");
    CHECK(follow(follower, *guest) > 0);
  }
}

TEST_CASE("resync brings a keyframe without a header, and the lines go on behind it") {
  House house(settings(8));
  house.room->start([] {});
  house.join(1);
  const auto eve = house.join(2, by_inputs("eve"));
  house.tick(80);
  follow::Follower follower("test");
  follow(follower, *eve);
  say(house, 2, protocol::Resync{});
  house.tick(10);
  const auto begin = std::find_if(eve->parts.begin(), eve->parts.end(), [](const StreamPart& part) {
    return part.kind != StreamPart::Kind::kSteps;
  });
  REQUIRE(begin != eve->parts.end());
  CHECK(begin->kind == StreamPart::Kind::kKeyframe);
  eve->parts.erase(eve->parts.begin(), begin);
  CHECK(follow(follower, *eve) > 5);
}

TEST_CASE("all who watched have gone and one comes again: nothing of the time between is told") {
  House house(settings(8));
  house.room->start([] {});
  house.join(1);
  house.join(2, by_inputs("eve"));
  house.tick(10);
  house.door->leave(2, Parting::kLeft);
  house.tick(10);
  const auto dan = house.join(3, by_inputs("dan"));
  house.tick(20);
  follow::Follower follower("test");
  CHECK(follow(follower, *dan) >= 17);
}

TEST_CASE("a room that stood still goes on for who comes to watch it") {
  House house(settings(8));
  house.room->start([] {});
  const auto eve = house.join(2, by_inputs("eve"));
  house.tick(30);
  house.door->leave(2, Parting::kLeft);
  house.tick(700);
  const std::uint64_t ticks = house.room->figures()->ticks;
  house.tick(100);
  CHECK(house.room->figures()->ticks == ticks);
  const auto dan = house.join(3, by_inputs("dan"));
  house.join(4);
  house.tick(80);
  follow::Follower follower("test");
  CHECK(follow(follower, *dan) >= 76);
}

TEST_CASE("another game begins with its header, behind the welcome") {
  SeenGames seen;
  HandmadeRotation turns(seen);
  Turning house(seen, turns);
  const auto ann = house.join(1, named("ann"));
  const auto eve = house.join(2, by_inputs("eve"));
  house.tick(30);
  follow::Follower follower("test");
  CHECK(follow(follower, *eve) > 20);
  CHECK(follower.match()->settings().mode == state::Mode::kHill);
  house.say(1, protocol::Skip{});
  house.next_game();
  follow(follower, *eve);  // the rest of the first
  house.tick(40);
  REQUIRE(eve->welcomes.size() == 2);
  CHECK(eve->welcomes[1].stream == protocol::Stream::kInputs);
  follow(follower, *eve);
  REQUIRE(follower.match() != nullptr);
  CHECK(follower.match()->settings().mode == state::Mode::kRoam);
  CHECK(follower.match()->tick() > 20);
}

}  // namespace woodlouse::server::test
