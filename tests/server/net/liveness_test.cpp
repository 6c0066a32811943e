// What a session makes of a client's silence, and what of its end.
#include <catch2/catch.hpp>

#include <chrono>
#include <string_view>

#include "server/net/session.h"
#include "tests/server/net/session_stage.h"

namespace woodlouse::server::liveness_test {

using std::chrono::seconds;

namespace {

constexpr std::string_view kPing = "{\"type\":\"ping\",\"t\":1}\n";
constexpr std::string_view kLeave = "{\"type\":\"leave\"}\n";
constexpr Duration kInstant = Duration(1);

}  // namespace

TEST_CASE(
    "the server pings who has joined, and of one that answered once, silence is a vacant seat, then the "
    "end") {
  Stage stage;
  stage.start_joined();
  stage.volcano->member->welcome({}, 1);
  stage.run();
  const seconds ping(stage.limits.ping_s), vacant(stage.limits.vacant_s), gone(stage.limits.resume_s);
  stage.pass(ping);
  CHECK(stage.last_line() == text_of(protocol::Ping{1}));
  stage.send("{\"type\":\"pong\",\"t\":1}\n");
  stage.pass(vacant - kInstant);
  CHECK(stage.volcano->vacated.empty());
  stage.pass(kInstant);
  CHECK(stage.volcano->vacated.size() == 1);
  stage.pass(gone - seconds(1));
  stage.send(kPing);  // it was only paused
  CHECK(stage.volcano->left.empty());
  stage.pass(vacant);
  CHECK(stage.volcano->vacated.size() == 2);
  stage.pass(gone - kInstant);
  CHECK(stage.volcano->left.empty());
  stage.pass(kInstant);
  CHECK(stage.volcano->left.size() == 1);
  CHECK(stage.has_got("nothing came from you for 45 s"));
  CHECK(stage.volcano->parting == Parting::kLeft);
}

TEST_CASE("who never answered a ping is not judged by its silence") {
  Stage stage;
  stage.start_joined();
  stage.volcano->member->welcome({}, 1);
  for (int k = 0; k < 1800; ++k) stage.pass(seconds(1));
  CHECK(stage.volcano->vacated.empty());
  CHECK(stage.volcano->left.empty());
}

TEST_CASE("a connection that ends is lost, `leave` and a fault of the client's are for good") {
  Stage stage;
  stage.start_joined();
  SECTION("it breaks") {
    stage.far->hang_up(boost::asio::error::connection_reset);
    stage.run();
    CHECK(stage.volcano->parting == Parting::kLost);
  }
  SECTION("it ends") {
    stage.far->hang_up();
    stage.run();
    CHECK(stage.volcano->parting == Parting::kLost);
  }
  SECTION("leave") {
    stage.send(kLeave);
    CHECK(stage.volcano->parting == Parting::kLeft);
  }
  SECTION("rubbish") {
    stage.send("x\nx\nx\n");
    CHECK(stage.volcano->parting == Parting::kLeft);
  }
}

}  // namespace woodlouse::server::liveness_test
