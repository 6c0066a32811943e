// How a session ends: by the clock, by word, by a fault of its connection.
#include <catch2/catch.hpp>

#include <string>
#include <utility>

#include "server/net/session.h"
#include "tests/server/net/session_stage.h"

namespace woodlouse::server::session_end_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr std::string_view kPing = "{\"type\":\"ping\",\"t\":1}\n";
constexpr std::string_view kLeave = "{\"type\":\"leave\"}\n";
constexpr Duration kInstant = Duration(1);
constexpr std::string_view kConnectionEnded =
    "info: session 000000000000002a of 10.0.0.1: connection ended\n";
const std::string kGoodbye = text_of(protocol::Bye{"left", "goodbye", false});

void say_everything(Subscriber& to) {
  to.deliver(as_line("late event\n"));
  to.answer(protocol::Pong{99});
  to.show({FrameKind::kKey, 60, 60, 60, as_line("late key\n")});
  to.show_again({FrameKind::kKey, 61, 61, 61, as_line("late key again\n")});
  to.deliver_map(as_line("late map\n"));
  to.refuse_join({"room_full", "late refusal", false, {}});
  to.welcome({}, 1);
}

}  // namespace

// ---- by the clock --------------------------------------------------------------------------------------

TEST_CASE("who does not join in time is ended, at that time and not before") {
  Stage stage;
  stage.start();
  stage.pass(seconds(stage.limits.handshake_s) - kInstant);
  CHECK(stage.lines().size() == 1);
  stage.pass(kInstant);
  CHECK(stage.last_line() == text_of(protocol::Bye{"handshake_timeout", "no join within 10 s", false}));
  CHECK(stage.lines().size() == 3);
  CHECK(stage.log.str() ==
        "info: session 000000000000002a of 10.0.0.1: ended: handshake_timeout: no join within 10 s\n");
}

TEST_CASE("talk without a join gives no more time for it") {
  Stage stage;
  stage.start();
  stage.pass(seconds(9));
  stage.send(kPing);
  stage.pass(seconds(1));
  CHECK(stage.has_got("handshake_timeout"));
}

TEST_CASE("who joined is ended when nothing was read or written for the idle time, not before") {
  Stage stage;
  stage.start();
  stage.pass(seconds(2));
  stage.send(kJoin);
  stage.far->holds_writes = true;  // of its pings none gets out
  stage.pass(seconds(stage.limits.idle_s) - kInstant);
  CHECK(stage.volcano->left.empty());
  stage.pass(kInstant);
  CHECK(stage.volcano->left.size() == 1);
  CHECK(stage.log.str().find("ended: idle: nothing read and nothing written for 60 s") != std::string::npos);
}

TEST_CASE("a line read or a write finished begins the idle time anew") {
  Stage stage;
  stage.start_joined();
  stage.far->holds_writes = true;
  stage.pass(seconds(40));
  stage.send(kPing);
  stage.pass(seconds(40));
  stage.far->let_go();
  stage.run();
  stage.far->holds_writes = true;
  stage.volcano->member->deliver(as_line("event\n"));
  stage.run();
  stage.pass(seconds(60) - kInstant);
  CHECK(stage.volcano->left.empty());
  stage.pass(kInstant);
  CHECK(stage.volcano->left.size() == 1);
}

TEST_CASE("a client that hangs in a write is ended as idle, and closed though it never takes the bye") {
  Stage stage;
  stage.start_joined();
  stage.far->holds_writes = true;
  stage.volcano->member->deliver(as_line("stuck\n"));
  stage.run();
  stage.pass(seconds(60));
  CHECK(stage.volcano->left.size() == 1);
  CHECK(stage.closed == 0);
  stage.pass(Session::kLinger);
  CHECK(stage.closed == 1);
  CHECK_FALSE(stage.has_got("\"bye\""));
}

// ---- by word -------------------------------------------------------------------------------------------

TEST_CASE("leave: a bye, the sending side is shut, and the linger time closes") {
  Stage stage;
  stage.start_joined();
  stage.send(kLeave);
  CHECK(stage.last_line() == kGoodbye);
  CHECK(stage.volcano->left == std::vector<SessionId>{Stage::kId});
  CHECK(stage.far->is_shut);
  stage.pass(Session::kLinger - kInstant);
  CHECK(stage.closed == 0);
  stage.pass(kInstant);
  CHECK(stage.closed == 1);
  CHECK(stage.log.str() == "info: session 000000000000002a of 10.0.0.1: left\n");
}

TEST_CASE("the client's end ends the linger time at once") {
  Stage stage;
  stage.start_joined();
  stage.send(kLeave);
  stage.far->hang_up();
  stage.run();
  CHECK(stage.closed == 1);
}

TEST_CASE("what comes in after the bye is read and thrown away") {
  Stage stage;
  stage.start();
  stage.send(kLeave);
  stage.send(kJoin);
  stage.send(std::string(100'000, 'x'));
  CHECK(stage.volcano->joins.empty());
  CHECK(stage.traffic.lines_received == 1);
  CHECK(stage.last_line() == kGoodbye);
}

TEST_CASE("the bye is the last line: nothing said after it goes out, and frames before it give way") {
  Stage stage;
  stage.start_joined();
  const auto member = stage.volcano->member;
  stage.far->holds_writes = true;
  member->deliver(as_line("in flight\n"));
  stage.run();
  member->deliver(as_line("waiting event\n"));
  member->deliver_map(as_line("waiting map\n"));
  member->show({FrameKind::kKey, 1, 1, 1, as_line("waiting key\n")});
  stage.run();
  member->end({"shutdown", "the server stops", false});
  say_everything(*member);
  stage.run();
  stage.far->let_go();
  stage.run();
  say_everything(*member);
  stage.run();
  const std::string end =
      "in flight\nwaiting event\n" + text_of(protocol::Bye{"shutdown", "the server stops", false});
  CHECK(stage.far->received.ends_with(end));
}

TEST_CASE("a room's bye lingers shortly, also where the session lingers already") {
  Stage stage;
  stage.start_joined();
  const auto member = stage.volcano->member;
  const bool has_left = GENERATE(false, true);
  if (has_left) stage.send(kLeave);
  member->end({"shutdown", "the server stops", false});
  stage.run();
  CHECK(stage.last_line() ==
        (has_left ? kGoodbye : text_of(protocol::Bye{"shutdown", "the server stops", false})));
  stage.pass(Session::kShutdownLinger - kInstant);
  CHECK(stage.closed == 0);
  stage.pass(kInstant);
  CHECK(stage.closed == 1);
}

TEST_CASE("a second bye does not lengthen the linger time") {
  Stage stage;
  stage.start_joined();
  const auto member = stage.volcano->member;
  stage.send(kLeave);
  stage.pass(Session::kLinger - milliseconds(100));
  member->end({"shutdown", "the server stops", false});
  stage.run();
  stage.pass(milliseconds(100));
  CHECK(stage.closed == 1);
}

// ---- by a fault ----------------------------------------------------------------------------------------

TEST_CASE("a read that fails closes and leaves the room") {
  Stage stage;
  stage.start_joined();
  stage.far->hang_up(boost::asio::error::connection_reset);
  stage.run();
  CHECK(stage.closed == 1);
  CHECK(stage.volcano->left == std::vector<SessionId>{Stage::kId});
  CHECK_FALSE(stage.has_got("\"bye\""));
  CHECK(stage.log.str() == kConnectionEnded);
}

TEST_CASE("a write that fails closes and leaves the room") {
  Stage stage;
  stage.start_joined();
  stage.far->write_error = boost::asio::error::broken_pipe;
  stage.volcano->member->deliver(as_line("event\n"));
  stage.run();
  CHECK(stage.closed == 1);
  CHECK(stage.volcano->left == std::vector<SessionId>{Stage::kId});
  CHECK(stage.traffic.bytes_sent == stage.far->received.size());
}

TEST_CASE("where the sending side cannot be shut the client has gone: it is closed without a linger time") {
  Stage stage;
  stage.start();
  stage.far->shut_down_error = boost::asio::error::not_connected;
  stage.send(kLeave);
  CHECK(stage.closed == 1);
  CHECK(stage.last_line() == kGoodbye);
}

TEST_CASE("a close that fails is logged, and the session is closed") {
  Stage stage;
  stage.start();
  stage.far->close_error = boost::asio::error::connection_reset;
  stage.far->hang_up();
  stage.run();
  CHECK(stage.closed == 1);
  CHECK(stage.log.str() ==
        "warning: session 000000000000002a of 10.0.0.1: close: " + stage.far->close_error.message() + "\n");
}

TEST_CASE("nothing is written and nothing is passed on after the close") {
  Stage stage;
  stage.start_joined();
  const auto member = stage.volcano->member;
  stage.far->holds_writes = true;
  member->deliver(as_line("in flight\n"));
  stage.run();
  stage.far->hang_up(boost::asio::error::connection_reset);
  stage.far->send(kPing);
  say_everything(*member);
  stage.run();
  const std::size_t writes = stage.far->writes;
  say_everything(*member);
  member->deliver(as_line(std::string(stage.limits.outbox_bytes + 1, 'x')));
  member->end({"shutdown", "the server stops", false});
  stage.send(kPing);
  stage.pass(seconds(100));
  CHECK(stage.far->writes == writes);
  CHECK(stage.log.str() == kConnectionEnded);
  CHECK_FALSE(stage.has_got("late"));
  CHECK_FALSE(stage.has_got("\"bye\""));
  CHECK(stage.closed == 1);
}

TEST_CASE("frames that come after the close are judged by nobody") {
  Stage stage;
  stage.start_joined();
  const auto member = stage.volcano->member;
  stage.far->hang_up();
  stage.run();
  for (std::uint64_t index = 0; index < 400; ++index) {
    member->show({FrameKind::kKey, index, index, index, as_line("late key\n")});
    stage.pass(milliseconds(50));
  }
  CHECK(stage.log.str() == kConnectionEnded);
}

TEST_CASE("who was refused leaves no room") {
  Stage stage;
  stage.start_joined();
  std::exchange(stage.volcano->member, nullptr)->refuse_join({"room_full", "full", false, {}});
  stage.run();
  stage.far->hang_up();
  stage.run();
  CHECK(stage.closed == 1);
  CHECK(stage.volcano->left.empty());
}

TEST_CASE("whichever call of the connection fails, the session closes once and leaves its room once") {
  std::size_t faults = 0;
  for (bool was_hit = true; was_hit; ++faults) {
    INFO("call " << faults);
    Stage stage;
    stage.far->faulty = faults;
    stage.start();
    stage.send(kJoin);
    if (const auto member = stage.volcano->member) {
      member->welcome({}, 1);
      stage.run();
      member->deliver(as_line("event\n"));
      stage.run();
    }
    stage.send(kPing);
    stage.send(kLeave);
    was_hit = stage.far->calls > faults;
    if (was_hit) CHECK(stage.closed == 1);
    stage.far->hang_up();
    stage.run();
    was_hit = stage.far->calls > faults;
    CHECK(stage.closed == 1);
    CHECK(stage.volcano->left.size() == stage.volcano->joins.size());
    const bool close_failed = stage.far->calls == faults + 1;
    CHECK((stage.log.str().find("close: ") != std::string::npos) == (was_hit && close_failed));
  }
  CHECK(faults > 10);
}

}  // namespace woodlouse::server::session_end_test
