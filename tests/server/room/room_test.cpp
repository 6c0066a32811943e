#include "server/room/room.h"

#include <catch2/catch.hpp>

#include <spdlog/sinks/null_sink.h>

#include <vector>

#include "shared/map/map_file.h"

using namespace woodlouse;
using namespace woodlouse::server;

namespace {

/// Keeps what a room says to it.
class Guest final : public Subscriber {
 public:
  void deliver(Line line) override { lines.push_back(*line); }
  void answer(protocol::ServerMessage message) override { answers.push_back(std::move(message)); }
  void show(const Frame& frame) override { frames.push_back(frame); }
  void show_again(const Frame& frame) override { frames.push_back(frame); }
  void deliver_map(Line line) override { maps.push_back(*line); }
  void refuse_join(protocol::ErrorMessage error) override { refusals.push_back(std::move(error)); }
  void welcome(protocol::Welcome message, std::uint32_t every) override {
    welcomes.push_back(std::move(message));
    divisor = every;
  }
  void end(protocol::Bye bye) override { byes.push_back(std::move(bye)); }

  std::vector<std::string> lines, maps;
  std::vector<protocol::ServerMessage> answers;
  std::vector<Frame> frames;
  std::vector<protocol::ErrorMessage> refusals;
  std::vector<protocol::Welcome> welcomes;
  std::vector<protocol::Bye> byes;
  std::uint32_t divisor = 0;
};

/// A room whose timer has not begun: what it does between two ticks.
struct House {
  explicit House(RoomSettings settings, Start start = open())
      : room(Room::make(ticks, io, std::move(settings), std::move(start), {}, log)), door(room->door()) {}

  static std::shared_ptr<const map::Map> load() {
    auto map = map::load_map(WOODLOUSE_SOURCE_DIR "/maps/volcano.json");
    REQUIRE(map);
    return *map;
  }

  static Start open() {
    const auto map = load();
    return {
        map, std::make_unique<match::Match>(map, match::MatchSettings{60, 0}), "maps/volcano.json", {}, {}};
  }

  std::shared_ptr<Guest> join(SessionId session, protocol::Join join = {}) {
    auto guest = std::make_shared<Guest>();
    if (join.fields.empty()) join.fields = protocol::default_columns();
    if (join.name.empty()) join.name = "guest" + std::to_string(session);
    door->join(session, guest, join);
    settle();
    return guest;
  }

  void settle() {
    while (ticks.poll() + io.poll() > 0) {
      ticks.restart();
      io.restart();
    }
    ticks.restart();
    io.restart();
  }

  boost::asio::io_context ticks{1}, io{1};
  std::shared_ptr<spdlog::logger> log =
      std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::null_sink_mt>());
  std::shared_ptr<Room> room;
  std::shared_ptr<Door> door;
};

RoomSettings settings(std::uint32_t per_room) {
  RoomSettings result;
  result.name = "volcano";
  result.per_room = per_room;
  return result;
}

}  // namespace

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
  CHECK(mara->lines.size() == 2);
  REQUIRE(spectator->welcomes.size() == 1);
  CHECK(spectator->welcomes[0].id == 0);
  REQUIRE(spectator->welcomes[0].players.size() == 1);
  CHECK(spectator->welcomes[0].players[0].name == "guest1");
  CHECK(spectator->lines.size() == 1);
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
  house.door->leave(1);
  CHECK(house.join(4)->welcomes.size() == 1);
}

TEST_CASE("too many different row layouts are refused, the ones in use are not") {
  House house(settings(100));
  protocol::Join join;
  join.fields = {protocol::Column::kId};
  std::vector<std::shared_ptr<Guest>> guests;
  for (SessionId session = 1; session <= Channels::kMaxLayouts + 1; ++session) {
    if (session % 2 == 0) join.fields.push_back(static_cast<protocol::Column>(session / 2));
    join.format = session % 2 == 0 ? protocol::Format::kExact : protocol::Format::kQuantized;
    guests.push_back(house.join(session, join));
  }
  CHECK(guests.back()->refusals.size() == 1);
  CHECK(guests[guests.size() - 2]->welcomes.size() == 1);
  join.fields = {protocol::Column::kId};
  join.format = protocol::Format::kQuantized;
  CHECK(house.join(99, join)->welcomes.size() == 1);
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

TEST_CASE("what a session says after it left, or after it was refused, changes nothing") {
  House house(settings(1));
  house.join(1);
  const auto refused = house.join(2);
  house.door->submit(2, protocol::Chat{"let me in"}, {});
  house.door->submit(2, protocol::Input{}, {});
  house.door->leave(2);
  house.door->leave(1);
  house.door->leave(1);
  house.door->submit(1, protocol::Chat{"still here"}, {});
  house.settle();
  CHECK(refused->answers.empty());
  const auto next = house.join(3);
  CHECK(next->lines.size() == 1);
  CHECK(house.room->census().players == 1);
}

TEST_CASE("more chat than the broadcaster hands out is refused with the time to wait, no event is lost") {
  House house(settings(8));
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

namespace {

/// A game that goes on after two players pushed: mara by her input 17, the other one, a bot, by none.
Start went_on() {
  Start start = House::open();
  const match::PlayerId mara = start.match->join();
  const match::PlayerId rolly = start.match->join();
  start.match->file({mara, 17, {state::ThrustKind::kAlongHeading, {0.5, 0.0}}, state::kHeld, 0});
  start.match->advance();
  start.unclaimed.push_back({mara, "mara", protocol::Role::kPlayer, 18, Nobody{}});
  start.unclaimed.push_back({rolly, "Rolly", protocol::Role::kBot, 0, Nobody{}});
  return start;
}

protocol::Join named(const std::string& name, protocol::Role role = protocol::Role::kPlayer) {
  protocol::Join join;
  join.name = name;
  join.role = role;
  return join;
}

}  // namespace

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
  CHECK(mara->welcomes[0].players.size() == 3);  // Rolly, the spectator and timo
  CHECK(house.join(4, named("mara"))->welcomes.at(0).id == 4);
}

TEST_CASE("whoever took a louse over counts its inputs from the start and is answered in that count") {
  House house(settings(8), went_on());
  const auto mara = house.join(1, named("mara"));
  protocol::Input input;
  input.seq = 0;
  input.thrust.value = {1.0, 0.0};
  house.door->submit(1, input, Clock::now());
  input.seq = 0;
  house.door->submit(1, input, Clock::now());
  house.settle();
  REQUIRE(mara->answers.size() == 2);  // of the second one: an error and an ack, dropped
  CHECK(std::get<protocol::ErrorMessage>(mara->answers[0]).code == "stale_seq");
  CHECK(std::get<protocol::Ack>(mara->answers[1]).dropped);
  house.room->start([] {});
  for (int turn = 0; turn < 1000 && mara->answers.size() < 3; ++turn) house.ticks.run_one();
  REQUIRE(mara->answers.size() == 3);
  const auto& ack = std::get<protocol::Ack>(mara->answers[2]);
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
  for (int turn = 0; turn < 30; ++turn) house.ticks.run_one();
  house.settle();
  const auto eve = house.join(1, named("eve", protocol::Role::kSpectator));
  REQUIRE(eve->welcomes.size() == 1);
  const auto& players = eve->welcomes[0].players;
  REQUIRE(players.size() == 3);  // mara, and two bots, one of them on a louse of its own
  CHECK(players[0].name == "mara");
  CHECK(players[1].name == name);
  CHECK(players[1].id == 2);
  CHECK(players[2].id == 3);
}

TEST_CASE("a room's figures may be read while it runs, and are whole once it has stopped") {
  House house(settings(8));
  CHECK(house.room->figures()->ticks == 0);
  house.room->start([] {});
  // A second of ticks, and the first of the next.
  for (int turn = 0; turn < 2000 && house.room->figures()->ticks == 0; ++turn) house.ticks.run_one();
  const auto first = house.room->figures();
  CHECK(first->ticks == 60);
  CHECK(first->lateness.count() == 60);
  for (int turn = 0; turn < 5; ++turn) house.ticks.run_one();
  CHECK(first->ticks == 60);  // a snapshot
  house.room->stop({"shutdown", "the server stops", false}, "test", [] {});
  house.settle();
  CHECK(house.room->figures()->ticks > 60);
}
