#include "server/room/lobby.h"

#include <catch2/catch.hpp>

#include <unistd.h>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/thread_pool.hpp>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "server/timing/steady_timekeeper.h"
#include "server/watchers/recorder.h"
#include "server/watchers/shadow.h"
#include "shared/replay/source_file.h"
#include "shared/replay/verify.h"
#include "tests/server/room/house.h"

using namespace woodlouse;
using namespace woodlouse::server;
using namespace woodlouse::server::test;

namespace {

/// A server's lobby without a port.
struct LobbyHouse : Contexts {
  std::shared_ptr<Room> make(const std::string& name, Watchers watchers = {}, Start start = open()) {
    RoomSettings settings;
    settings.name = name;
    settings.bots = watchers.empty() ? 0 : 2;
    return Room::make(ticks, lanes, std::move(settings), std::move(start), std::move(watchers), timekeeper,
                      log);
  }
  /// Recorded and shadowed, as the server makes one.
  std::shared_ptr<Room> make_watched(const std::string& name, const std::filesystem::path& file,
                                     boost::asio::thread_pool& shadows) {
    Start start = open();
    const replay::Header header = replay::make_header(*start.match, "test", start.map_file);
    Watchers watchers;
    auto recorder = Recorder::open(std::make_shared<RecordingFiles>(*RecordPattern::parse(file.string(), 1)),
                                   name, header, {}, log);
    REQUIRE(recorder);
    watchers.push_back(std::move(*recorder));
    watchers.push_back(std::make_unique<Shadow>(name, start.map, header, file, shadows, log));
    return make(name, std::move(watchers), std::move(start));
  }

  SteadyTimekeeper timekeeper;
  Lobby lobby;
};

}  // namespace

TEST_CASE("rooms are found by name, the first one without, in the order they were opened") {
  LobbyHouse house;
  CHECK(house.lobby.find("") == nullptr);
  REQUIRE(house.lobby.open(house.make("hills"), [] {}));
  REQUIRE(house.lobby.open(house.make("arena"), [] {}));
  CHECK_FALSE(house.lobby.open(house.make("hills"), [] {}));
  CHECK(house.lobby.names() == std::vector<std::string>{"hills", "arena"});
  CHECK(house.lobby.find("")->name() == "hills");
  CHECK(house.lobby.find("arena")->name() == "arena");
  CHECK(house.lobby.find("moon") == nullptr);
  house.join(*house.lobby.find("arena"), 1);
  const protocol::Rooms list = house.lobby.list();
  REQUIRE(list.rooms.size() == 2);
  CHECK(list.rooms[0].players == 0);
  CHECK(list.rooms[1].players == 1);
  CHECK(list.rooms[1].map == "volcano");
}

TEST_CASE("a room that closes says bye to its members, and the doors that are held refuse") {
  LobbyHouse house;
  REQUIRE(house.lobby.open(house.make("hills"), [] {}));
  REQUIRE(house.lobby.open(house.make("arena"), [] {}));
  const auto door = house.lobby.find("hills");
  const auto inside = house.join(*door, 1);
  const auto elsewhere = house.join(*house.lobby.find("arena"), 2);
  bool closed = false;
  REQUIRE(
      house.lobby.close("hills", {"shutdown", "the room closes", false}, "closed", [&] { closed = true; }));
  CHECK(house.lobby.find("hills") == nullptr);
  CHECK(house.lobby.names() == std::vector<std::string>{"arena"});
  house.settle();
  CHECK(closed);
  REQUIRE(inside->byes.size() == 1);
  CHECK(inside->byes[0].text == "the room closes");
  CHECK(elsewhere->byes.empty());

  const auto late = house.join(*door, 3);
  REQUIRE(late->refusals.size() == 1);
  CHECK(late->refusals[0].code == "shutdown");
  CHECK_FALSE(late->refusals[0].fatal);
  door->submit(1, protocol::Chat{"anybody?"}, {});
  door->leave(1, Parting::kLeft);
  CHECK(door->census().players == 0);
  CHECK(door->census().map == "volcano");
  CHECK_FALSE(house.lobby.close("hills", {}, "closed", [] {}));
}

TEST_CASE("a closed room leaves memory though its door is held") {
  LobbyHouse house;
  std::weak_ptr<Room> room;
  {
    const auto made = house.make("hills");
    room = made;
    REQUIRE(house.lobby.open(made, [] {}));
  }
  const auto door = house.lobby.find("hills");
  const auto guest = house.join(*door, 1);
  REQUIRE_FALSE(room.expired());
  REQUIRE(house.lobby.close("hills", {}, "closed", [] {}));
  house.settle();
  CHECK(room.expired());
  CHECK(guest.use_count() == 1);
}

TEST_CASE(
    "a recorded and shadowed room that closes leaves memory, its recording whole, and a stop waits for it") {
  LobbyHouse house;
  const auto file = std::filesystem::temp_directory_path() /
                    ("woodlouse_lobby_test_" + std::to_string(::getpid()) + ".ndjson");
  boost::asio::thread_pool shadows(1);
  std::weak_ptr<Room> room;
  {
    const auto made = house.make_watched("hills", file, shadows);
    room = made;
    REQUIRE(house.lobby.open(made, [] {}));
  }
  const auto door = house.lobby.find("hills");
  CHECK(house.join(*door, 1)->welcomes.size() == 1);
  house.ticks.run_for(std::chrono::milliseconds(100));
  bool closed = false;
  bool stopped = false;
  REQUIRE(house.lobby.close("hills", {}, "closed", [&] { closed = true; }));
  CHECK(house.lobby.stop({}, "test", [&] { stopped = true; }) == 1);  // it is closing still
  while (!closed || !stopped || !room.expired()) house.settle();
  shadows.join();
  const auto verdict = replay::verify(replay::source_of_file(file));
  REQUIRE(verdict);
  CHECK(verdict->ok());
  CHECK_FALSE(verdict->cut_off);
  CHECK(verdict->ticks > 0);
  std::filesystem::remove(file);
}

TEST_CASE("a lobby that stops ends every room once, keeps them in its list and opens none any more") {
  LobbyHouse house;
  REQUIRE(house.lobby.open(house.make("hills"), [] {}));
  REQUIRE(house.lobby.open(house.make("arena"), [] {}));
  const auto guest = house.join(*house.lobby.find("arena"), 1);
  int stopped = 0;
  CHECK(house.lobby.stop({"shutdown", "the server stops", false}, "test", [&] { ++stopped; }) == 2);
  house.settle();
  CHECK(stopped == 2);
  CHECK(guest->byes.size() == 1);
  CHECK(house.lobby.names().size() == 2);
  CHECK_FALSE(house.lobby.open(house.make("late"), [] {}));
  CHECK(house.join(*house.lobby.find("hills"), 2)->refusals.size() == 1);
}

TEST_CASE("a name may be opened again once its room is closed") {
  LobbyHouse house;
  for (int round = 0; round < 3; ++round) {
    REQUIRE(house.lobby.open(house.make("hills"), [] {}));
    const auto guest = house.join(*house.lobby.find("hills"), 1);
    CHECK(guest->welcomes.size() == 1);
    bool closed = false;
    REQUIRE(house.lobby.close("hills", {}, "closed", [&] { closed = true; }));
    house.settle();
    CHECK(closed);
  }
}

TEST_CASE("rooms open and close while others look, join and leave") {
  LobbyHouse house;
  REQUIRE(house.lobby.open(house.make("steady"), [] {}));
  auto work_ticks = boost::asio::make_work_guard(house.ticks);
  auto work_io = boost::asio::make_work_guard(house.io);
  std::thread ticking([&] { house.ticks.run(); });
  std::thread sending([&] { house.io.run(); });
  std::atomic<bool> over{false};
  std::atomic<int> visits{0};
  std::vector<std::thread> visitors;
  for (SessionId first = 1; first <= 2; ++first) {
    visitors.emplace_back([&, first] {
      for (SessionId session = first; !over; session += 2) {
        for (const std::string& name : house.lobby.names()) {
          if (const auto door = house.lobby.find(name)) {
            auto guest = std::make_shared<Guest>();
            protocol::Join join;
            join.name = "guest";
            join.fields = protocol::default_columns();
            door->join({session, guest, join, 1, Time{}});
            door->leave(session, Parting::kLeft);
            ++visits;
          }
        }
        static_cast<void>(house.lobby.list());
        std::this_thread::yield();
      }
    });
  }
  std::atomic<int> closed{0};
  int opened = 0;
  for (; opened < 50 || visits < 200; ++opened) {
    auto room = house.make("guest room");
    REQUIRE(house.lobby.open(std::move(room), [] {}));
    std::this_thread::yield();
    REQUIRE(house.lobby.close("guest room", {}, "closed", [&] { ++closed; }));
  }
  over = true;
  for (std::thread& visitor : visitors) visitor.join();
  REQUIRE(house.lobby.close("steady", {}, "closed", [&] { ++closed; }));
  while (closed < opened + 1) std::this_thread::yield();
  work_ticks.reset();
  work_io.reset();
  ticking.join();
  sending.join();
  CHECK(house.lobby.names().empty());
}
