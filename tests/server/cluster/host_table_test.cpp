#include "server/cluster/host_table.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <map>
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
  CHECK(table.addresses(kNow) == Lines{"b:7777"});
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

TEST_CASE("what a newer build says more is passed over") {
  Beat beat = owner("b", "main", 3, {"volcano"});
  beat.strict = true;
  std::string text = to_text(beat);
  text.insert(1, R"("colour":{"of":["a","host"]},)");
  text.insert(text.find(R"({"name":"volcano")") + 1, R"("height":3,)");
  CHECK(beat_from(text) == beat);
  text.replace(text.find(R"("strict":true)"), 13, R"("strict":"no")");
  CHECK_FALSE(beat_from(text));
}

TEST_CASE("an address at which nobody can be reached is heard as none") {
  for (const std::string address : {"nonsense", "127.0.0.1:0", "my host:7", "[fe80::1%eth0]:7777",
                                    "edge.example", ":7777", "a:99999", ""}) {
    Beat beat = owner("b", "main", 3, {});
    beat.address = address;
    const auto read = beat_from(to_text(beat));
    REQUIRE(read);
    CHECK(read->address.empty());
  }
}

TEST_CASE("who is heard for the first time is told apart from who goes on, of any shard") {
  HostTable table("me", "main", 7);
  Beat beat = owner("b", "main", 3, {});
  CHECK(table.take(beat, kNow));
  CHECK_FALSE(table.take(beat, kNow));
  beat.process = 5;  // begun anew
  CHECK(table.take(beat, kNow));
  CHECK(table.take(owner("x", "other", 9, {}), kNow));
  Beat own = owner("me", "main", 1, {});
  own.process = 7;
  CHECK_FALSE(table.take(own, kNow));
  const Time later = kNow + 2 * HostTable::kForgottenAfter;
  for (Time now = kNow; now < later; now += std::chrono::seconds(1)) table.take(own, now);
  CHECK(table.take(beat, later));
  beat.shard = "other";
  CHECK(table.take_edge(beat, kNow));
  CHECK_FALSE(table.take_edge(beat, kNow));
}

TEST_CASE("edges are no hosts, two may have one name, and who asks for some is told of others each time") {
  HostTable table("", "main", 7);
  const auto edge = [](std::uint64_t process, const std::string& address) {
    Beat beat;
    beat.host = "e";
    beat.shard = "main";
    beat.process = process;
    beat.address = address;
    beat.ready = true;
    return beat;
  };
  for (std::uint64_t k = 1; k <= 3; ++k) table.take_edge(edge(k, std::to_string(k) + ":7777"), kNow);
  table.take_edge(edge(7, "own:7777"), kNow);
  table.take_edge(edge(8, ""), kNow);  // told no address
  Beat late = edge(9, "late:7777");
  late.ready = false;
  table.take_edge(late, kNow);
  Beat going = edge(10, "going:7777");
  going.leaves = true;
  table.take_edge(going, kNow);
  Beat stranger = edge(11, "stranger:7777");
  stranger.shard = "other";
  table.take_edge(stranger, kNow);
  Beat liar = owner("l", "main", 99, {"volcano"});  // it owns nothing, whatever it says
  liar.process = 12;
  table.take_edge(liar, kNow);
  CHECK(told(table, kNow).empty());
  CHECK(table.highest_epoch() == 0);
  CHECK(table.edges(kNow).size() == 7);
  CHECK(table.hosts(kNow).empty());
  CHECK_FALSE(table.successor(kNow));
  table.take_edge(edge(13, "3:7777"), kNow);  // behind the same load balancer
  const Lines all{"1:7777", "2:7777", "3:7777"};
  std::map<std::string, int> first;
  for (int k = 0; k < 600; ++k) {
    const Lines told = table.edge_addresses(kNow);
    REQUIRE(std::is_permutation(told.begin(), told.end(), all.begin(), all.end()));
    ++first[table.edge_addresses(kNow).at(0)];  // of two that ask by turns each is told of all
  }
  for (const std::string& address : all) CHECK(first[address] > 120);
  for (std::uint64_t k = 0; k < HostTable::kMostEdges + 5; ++k) table.take_edge(edge(1000 + k, "x:1"), kNow);
  CHECK(table.edges(kNow).size() < HostTable::kMostEdges);
}

TEST_CASE("of an owner it is known whether its mode is strict, if it says so") {
  HostTable table("me", "main", 7);
  Beat beat = owner("b", "main", 3, {});
  table.take(beat, kNow);
  CHECK_FALSE(table.is_strict(beat.writer));
  beat.strict = false;
  table.take(beat, kNow);
  CHECK(table.is_strict(beat.writer) == std::optional(false));
  CHECK_FALSE(table.is_strict({4, "b", {1, 2}}));
}

TEST_CASE("who is silent is forgotten, but nobody while this host hears nothing, or has for a while only") {
  HostTable table("me", "main", 7);
  Beat own = owner("me", "main", 3, {});
  own.process = 7;
  Beat other = owner("b", "main", 2, {});
  other.owns = false;
  Beat edge = owner("e", "main", 0, {});
  edge.ready = true;
  edge.process = 8;
  const auto hear = [&](Time from, Time to, bool others) {
    for (Time now = from; now <= to; now += std::chrono::milliseconds(50)) {
      table.take(own, now);
      if (!others) continue;
      table.take(other, now);
      table.take_edge(edge, now);
    }
  };
  const auto known = [&table](Time now) {
    return table.addresses(now).size() + table.edge_addresses(now).size();
  };
  const Duration moment = std::chrono::milliseconds(100), long_time = HostTable::kForgottenAfter;
  const Time cut = kNow + 2 * long_time;
  hear(kNow, cut, true);
  CHECK(known(cut) == 2);
  CHECK(known(cut + 20 * long_time) == 2);  // nothing is heard
  const Time back = cut + 20 * long_time;
  hear(back, back + moment, false);
  CHECK(known(back + moment) == 2);
  hear(back + moment, back + long_time, false);
  CHECK(known(back + long_time) == 2);
  hear(back + long_time, back + long_time + moment, false);
  CHECK(known(back + long_time + moment) == 0);
  hear(back + long_time + moment, back + 2 * long_time, true);
  CHECK(known(back + 2 * long_time) == 2);
  const Time silent = back + 2 * long_time;
  hear(silent, silent + long_time, false);
  CHECK(known(silent + long_time) == 2);
  hear(silent + long_time, silent + long_time + moment, false);
  CHECK(known(silent + long_time + moment) == 0);
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
