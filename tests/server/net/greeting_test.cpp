// When a session says hello, and what who speaks HTTP to it is told.
#include <catch2/catch.hpp>

#include <chrono>
#include <string>
#include <string_view>

#include "server/net/session.h"
#include "shared/protocol/messages.h"
#include "tests/server/net/session_stage.h"

namespace woodlouse::server::greeting_test {

using std::chrono::seconds;

namespace {

constexpr std::string_view kPing = "{\"type\":\"ping\",\"t\":1}\n";

}  // namespace

TEST_CASE("where the client speaks first hello follows its first line, whatever that is") {
  Stage stage;
  stage.start(Session::Greeting::kAfterFirstLine);
  CHECK(stage.far->received.empty());
  const auto hello = [&stage] { return stage.lines().at(0).starts_with(R"({"type":"hello")"); };
  SECTION("a ping, in two parts") {
    stage.send(kPing.substr(0, 5));
    CHECK(stage.far->received.empty());
    stage.send(kPing.substr(5));
    stage.send(kPing);
    REQUIRE(stage.lines().size() == 3);
    CHECK(hello());
    CHECK(stage.lines()[1] == text_of(protocol::Pong{1}));
  }
  SECTION("a blank line") {
    stage.send("\n");
    REQUIRE(stage.lines().size() == 2);
    CHECK(hello());
    CHECK(stage.has_got("bad_json"));
  }
  SECTION("a line that is too long") {
    stage.send(std::string(stage.limits.line + 1, 'x') + '\n');
    REQUIRE(stage.lines().size() == 3);
    CHECK(hello());
    CHECK(stage.has_got("line_too_long"));
  }
  SECTION("a join") {
    stage.send(kJoin);
    CHECK(hello());
    CHECK(stage.volcano->joins.size() == 1);
  }
}

TEST_CASE("who says no line where the client speaks first is told no hello at the end either") {
  Stage stage;
  stage.start(Session::Greeting::kAfterFirstLine);
  stage.send("{");
  stage.pass(seconds(stage.limits.handshake_s));
  REQUIRE(stage.lines().size() == 2);
  CHECK_FALSE(stage.has_got("hello"));
  CHECK(stage.has_got("handshake_timeout"));
}

TEST_CASE("an HTTP request on the port of lines is told where the page is") {
  Stage stage;
  stage.environment.web_url = "http://127.0.0.1:7778/";
  stage.start();
  stage.send("GET / HTTP/1.1\r\n");
  CHECK(stage.has_got("bad_json"));
  CHECK(stage.last_line().find("open http://127.0.0.1:7778/") != std::string::npos);
}

}  // namespace woodlouse::server::greeting_test
