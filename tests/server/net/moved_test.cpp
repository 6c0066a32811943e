// What a session says of rooms that are at another server.
#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/protocol/whereabouts.h"
#include "tests/server/net/session_stage.h"

namespace woodlouse::server::moved_test {

TEST_CASE("a room that is elsewhere is told with its address, and the session ends") {
  Stage stage;
  std::vector<std::string> asked;
  stage.environment.elsewhere = [&asked](std::string_view room) -> std::optional<std::string> {
    asked.emplace_back(room);
    return room == "moon" ? std::optional<std::string>("10.0.0.6:7777") : std::nullopt;
  };
  stage.start();
  const std::string join = R"({"type":"join","protocol":1,"role":"player","name":"ann","room":")";
  stage.send(join + "mars\"}\n");
  CHECK(stage.has_got("unknown_room"));
  stage.far->received.clear();
  stage.send(join + "moon\"}\n");
  const std::string text = "join.room: \"moon\" is at 10.0.0.6:7777 now";
  CHECK(stage.far->received == text_of(protocol::ErrorMessage{"moved", text, true, {}, "10.0.0.6:7777"}) +
                                   text_of(protocol::Bye{"moved", text, true, "10.0.0.6:7777"}));
  CHECK(stage.far->is_shut);
  CHECK(asked == std::vector<std::string>{"mars", "moon"});
  CHECK(stage.log.str().find("ended: moved") != std::string::npos);
}

TEST_CASE("a room that is here is not looked for elsewhere") {
  Stage stage;
  stage.environment.elsewhere = [](std::string_view) -> std::optional<std::string> {
    FAIL("asked");
    return std::nullopt;
  };
  stage.start_joined();
  CHECK(stage.volcano->joins.size() == 1);
}

TEST_CASE("a room's bye sends its members on, and whoever is sent on may go on there") {
  Stage stage;
  stage.start_joined();
  const protocol::Bye bye{"moved", "room volcano is at 10.0.0.6:7777 now", true, "10.0.0.6:7777"};
  stage.session->end(bye);
  stage.run();
  CHECK(stage.last_line() == text_of(bye));
}

TEST_CASE("hello names the other hosts, of many the first") {
  Stage stage;
  std::vector<std::string> hosts;
  for (int k = 1; k <= 20; ++k) hosts.push_back("10.0.0." + std::to_string(k) + ":7777");
  stage.environment.hosts = [&hosts] { return hosts; };
  stage.start();
  hosts.resize(protocol::kMaxHosts);
  const auto hello = protocol::decode_server(stage.last_line(), {}, protocol::Format::kExact);
  REQUIRE(hello);
  CHECK(std::get<protocol::Hello>(*hello).hosts == hosts);
}

TEST_CASE("a ping names the other hosts once they are others, whatever order they are told in") {
  using Hosts = std::optional<std::vector<std::string>>;
  Stage stage;
  std::vector<std::string> hosts{"10.0.0.1:7777", "10.0.0.2:7777"};
  stage.environment.hosts = [&hosts] { return hosts; };
  stage.start_joined();
  stage.volcano->member->welcome({}, 1);
  stage.run();
  const auto next_ping = [&stage] {
    stage.pass(std::chrono::seconds(stage.limits.ping_s));
    const auto ping = protocol::decode_server(stage.last_line(), {}, protocol::Format::kExact);
    REQUIRE(ping);
    return std::get<protocol::Ping>(*ping).hosts;
  };
  CHECK(next_ping() == Hosts());
  hosts = {"10.0.0.2:7777", "10.0.0.1:7777"};
  CHECK(next_ping() == Hosts());
  hosts.emplace_back("10.0.0.3:7777");
  CHECK(next_ping() == Hosts(hosts));
  CHECK(next_ping() == Hosts());
  hosts.clear();
  CHECK(next_ping() == Hosts(hosts));
  for (int k = 1; k <= 20; ++k) hosts.push_back("10.0.0." + std::to_string(k) + ":7777");
  CHECK(next_ping() == Hosts({hosts.begin(), hosts.begin() + protocol::kMaxHosts}));
  for (int k = 0; k < 20; ++k) {  // as of many edges each is named first by turns
    std::rotate(hosts.begin(), hosts.begin() + 3, hosts.end());
    CHECK(next_ping() == Hosts());
  }
  hosts.erase(std::find(hosts.begin(), hosts.end(), "10.0.0.4:7777"));
  CHECK(next_ping()->size() == protocol::kMaxHosts);
  CHECK(next_ping() == Hosts());
}

}  // namespace woodlouse::server::moved_test
