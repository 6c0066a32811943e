#include "server/cluster/room_guide.h"

#include <catch2/catch.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/server/net/session_stage.h"

namespace woodlouse::server::room_guide_test {

namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(c | 0x20);
  return text;
}

HostedRoom hosted(const std::string& shard, const std::string& room, const std::string& address) {
  return {shard, {room, room, 1, 2, 3, {}, address}};
}

/// A host with two rooms in a cluster that a test writes.
struct Guided {
  Guided() {
    guide.use({"woodlouse", "main", [this] { return others; },
               [this](std::string_view room) -> std::optional<std::string> {
                 for (const HostedRoom& one : others)
                   if (one.shard == "main" && one.room.name == room) return is_moving ? "" : one.room.address;
                 return std::nullopt;
               }});
  }
  [[nodiscard]] std::string code_of(const std::string& room, const std::string& address = {}) const {
    for (const protocol::RoomEntry& one : guide.list().rooms)
      if (one.name == room && one.address == address) return one.code;
    return {};
  }

  std::shared_ptr<FakeDoor> volcano = std::make_shared<FakeDoor>("volcano");
  FakeDirectory here{{volcano, std::make_shared<FakeDoor>("hills")}};
  std::vector<HostedRoom> others;
  bool is_moving = false;
  RoomGuide guide{here};
};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("alone a server's rooms are its own, with codes") {
  const auto door = std::make_shared<FakeDoor>("volcano");
  FakeDirectory here({door});
  const RoomGuide guide(here);
  const protocol::Rooms list = guide.list();
  REQUIRE(list.rooms.size() == 1);
  CHECK(list.rooms[0].code == join_codes("", {{"", "volcano"}}).front());
  CHECK(list.rooms[0].address.empty());
  CHECK(guide.find(list.rooms[0].code) == door);
  CHECK(guide.find("") == door);
  CHECK(guide.find("BCDFG") == nullptr);
  CHECK_FALSE(guide.elsewhere("moon"));
  CHECK(guide.names() == Names{"volcano"});
  here.times_changed = 4;
  CHECK(guide.changes() == 4);
}

TEST_CASE("rooms of other hosts are told behind one's own, with their addresses") {
  Guided host;
  host.others = {hosted("other", "moon", "x:1"), hosted("main", "mars", "b:1"),
                 hosted("alps", "hills", "y:1"), hosted("main", "no address", "")};
  const protocol::Rooms list = host.guide.list();
  Names told;
  for (const protocol::RoomEntry& one : list.rooms) told.push_back(one.name + " " + one.address);
  CHECK(told == Names{"volcano ", "hills ", "hills y:1", "mars b:1", "moon x:1"});
  CHECK(list.rooms[3].bots == 2);
  CHECK(host.guide.names() == Names{"volcano", "hills", "mars", "moon"});
}

TEST_CASE("a room is found by its code, in capitals or not, here and elsewhere") {
  Guided host;
  host.others = {hosted("main", "mars", "b:1"), hosted("other", "hills", "x:1")};
  CHECK(host.guide.find(lower(host.code_of("volcano"))) == host.volcano);
  CHECK_FALSE(host.guide.find(host.code_of("mars", "b:1")));
  CHECK(host.guide.elsewhere(host.code_of("mars", "b:1")) == "b:1");
  CHECK(host.guide.elsewhere(lower(host.code_of("hills", "x:1"))) == "x:1");
  CHECK(host.code_of("hills") != host.code_of("hills", "x:1"));
  CHECK_FALSE(host.guide.elsewhere("BCDFG"));
}

TEST_CASE("a room of another shard is found by its name, unless there is one in this host's shard") {
  Guided host;
  host.others = {hosted("other", "moon", "x:1"), hosted("main", "mars", "b:1"),
                 hosted("other", "mars", "x:1")};
  CHECK(host.guide.elsewhere("moon") == "x:1");
  CHECK(host.guide.elsewhere("mars") == "b:1");
  CHECK_FALSE(host.guide.elsewhere("pluto"));
}

TEST_CASE("a room that has a code for its name is meant by it") {
  Guided host;
  host.others = {hosted("main", host.code_of("volcano"), "b:1")};
  const std::string name = host.others.front().room.name;
  CHECK_FALSE(host.guide.find(name));
  CHECK(host.guide.elsewhere(name) == "b:1");
}

TEST_CASE("a room that is about to go on is so by its code, too") {
  Guided host;
  host.others = {hosted("main", "mars", "b:1")};
  host.is_moving = true;
  CHECK(host.guide.elsewhere("mars") == "");
  CHECK(host.guide.elsewhere(host.code_of("mars", "b:1")) == "");
}

TEST_CASE("what a host still says of rooms that are here by now is passed over") {
  Guided host;
  host.others = {hosted("main", "volcano", "b:1")};
  CHECK(host.guide.list().rooms.size() == 2);
  CHECK(host.code_of("volcano", "b:1").empty());
}

TEST_CASE("who watches the rooms hears of each that comes, goes or moves elsewhere") {
  Guided host;
  const std::uint64_t alone = host.guide.changes();
  host.others = {hosted("main", "mars", "b:1")};
  const std::uint64_t with_mars = host.guide.changes();
  CHECK(with_mars != alone);
  host.others.front().room.players = 9;
  CHECK(host.guide.changes() == with_mars);
  host.others.front().room.address = "c:1";
  CHECK(host.guide.changes() != with_mars);
  host.others.clear();
  CHECK(host.guide.changes() == alone);
  ++host.here.times_changed;
  CHECK(host.guide.changes() != alone);
}

}  // namespace woodlouse::server::room_guide_test
