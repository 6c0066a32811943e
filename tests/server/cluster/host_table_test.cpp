#include "server/cluster/host_table.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace woodlouse::server::host_table_test {

namespace {

constexpr Time kNow{std::chrono::hours(1)};

Beat owner(const std::string& host, const std::string& shard, std::uint64_t epoch,
           std::vector<std::string> rooms) {
  Beat beat;
  beat.host = host;
  beat.address = host + ":7777";
  beat.shard = shard;
  beat.owns = true;
  beat.writer = {epoch, host, {1, 2}};
  beat.rooms.emplace();
  for (std::string& room : rooms) beat.rooms->push_back({std::move(room), "hills", 1, 2, 3});
  return beat;
}

std::vector<std::string> told(const HostTable& table, Time now) {
  std::vector<std::string> lines;
  for (const HostedRoom& one : table.rooms(now))
    lines.push_back(one.shard + " " + one.room.name + " " + one.room.address);
  return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("rooms are told with the address of the host that owns their shard, of every shard") {
  HostTable table("me", "main", 7);
  table.take(owner("b", "main", 3, {"volcano", "hills"}), kNow);
  table.take(owner("x", "other", 9, {"volcano"}), kNow);
  CHECK(told(table, kNow) == Lines{"main volcano b:7777", "main hills b:7777", "other volcano x:7777"});
  CHECK(table.rooms(kNow).front().room.players == 1);
  // Of other shards nothing else is asked for.
  CHECK(table.hosts(kNow).size() == 1);
  CHECK(table.addresses(kNow, 16) == Lines{"b:7777"});
  CHECK(table.highest_epoch() == 3);
}

TEST_CASE("of two that claim a shard the later epoch tells") {
  HostTable table("me", "main", 7);
  table.take(owner("c", "main", 5, {"volcano"}), kNow);
  table.take(owner("b", "main", 4, {"volcano", "hills"}), kNow);
  CHECK(told(table, kNow) == Lines{"main volcano c:7777"});
}

TEST_CASE(
    "rooms of a host that is silent are told till it is forgotten, and not those of one that stands by") {
  HostTable table("me", "main", 7);
  table.take(owner("b", "main", 3, {"volcano"}), kNow);
  CHECK(told(table, kNow + HostTable::kForgottenAfter) == Lines{"main volcano b:7777"});
  CHECK_FALSE(table.owner(kNow + HostTable::kForgottenAfter));
  CHECK(told(table, kNow + HostTable::kForgottenAfter + std::chrono::milliseconds(1)).empty());
  Beat follower = owner("b", "main", 3, {"volcano"});
  follower.owns = false;
  table.take(follower, kNow);
  CHECK(told(table, kNow).empty());
}

TEST_CASE("a beat without rooms leaves them as they were told, of the same process, while it owns them") {
  HostTable table("me", "main", 7);
  table.take(owner("b", "main", 3, {"volcano"}), kNow);
  Beat brief = owner("b", "main", 3, {});
  brief.rooms.reset();
  const Time later = kNow + HostTable::kForgottenAfter;
  table.take(brief, later);
  CHECK(told(table, later + std::chrono::seconds(4)) == Lines{"main volcano b:7777"});
  table.take(owner("b", "main", 3, {"hills"}), later);
  table.take(brief, later);
  CHECK(told(table, later) == Lines{"main hills b:7777"});
  Beat of_another = brief;
  of_another.process = brief.process + 1;
  table.take(of_another, later);
  CHECK(told(table, later).empty());
  table.take(owner("b", "main", 3, {"hills"}), later);
  brief.owns = false;
  table.take(brief, later);
  brief.owns = true;
  table.take(brief, later);
  CHECK(told(table, later).empty());
}

TEST_CASE("of two hosts of one name the owner is believed till it is silent") {
  HostTable table("me", "main", 7);
  table.take(owner("b", "main", 3, {"volcano"}), kNow);
  Beat twin;
  twin.host = "b";
  twin.shard = "main";
  twin.process = 99;
  const Time soon = kNow + std::chrono::milliseconds(900);
  table.take(twin, soon);
  CHECK(told(table, soon) == Lines{"main volcano b:7777"});
  CHECK(table.owner(soon));
  table.take(twin, kNow + std::chrono::seconds(1));
  CHECK(told(table, kNow + std::chrono::seconds(1)).empty());
}

TEST_CASE("a beat is read as it was told, with rooms, with none, and without a word of them") {
  for (const auto& rooms : {std::vector<std::string>{}, std::vector<std::string>{"volcano", "hills"}}) {
    const Beat beat = owner("b", "main", 3, rooms);
    CHECK(beat_from(to_text(beat)) == beat);
  }
  Beat brief = owner("b", "main", 3, {});
  brief.rooms.reset();
  CHECK(beat_from(to_text(brief)) == brief);
  Beat full = owner("b", "main", 3, {});
  for (std::size_t k = 0; k < kMostRoomsOfShard; ++k)
    full.rooms->push_back({std::string(80, 'r'), std::string(80, 'm'), 1000, 1000, 1000});
  CHECK(beat_from(to_text(full)) == full);
  full.rooms->push_back({"one", "too many", 0, 0, 0});
  CHECK_FALSE(beat_from(to_text(full)));
}

TEST_CASE("hosts of other shards are bounded, and forgotten") {
  HostTable table("me", "main", 7);
  for (std::size_t k = 0; k < HostTable::kMostHosts + 10; ++k)
    table.take(owner("x" + std::to_string(k), "s" + std::to_string(k), 1, {"hills"}), kNow);
  CHECK(told(table, kNow).size() == HostTable::kMostHosts);
  const Time later = kNow + HostTable::kForgottenAfter + std::chrono::seconds(1);
  table.take(owner("y", "t", 1, {"hills"}), later);
  CHECK(told(table, later) == Lines{"t hills y:7777"});
}

}  // namespace woodlouse::server::host_table_test
