// What a session reads, passes on and says while it is open.
#include "server/net/session.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <variant>

#include "shared/core/stable_hash.h"
#include "shared/match/match.h"
#include "shared/protocol/codes.h"
#include "tests/server/net/session_stage.h"

namespace woodlouse::server::session_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr std::string_view kPing = "{\"type\":\"ping\",\"t\":1}\n";
constexpr std::string_view kChat = "{\"type\":\"chat\",\"text\":\"hi\"}\n";

protocol::Limits limits_of_rate(std::uint32_t messages_per_s, std::uint32_t burst) {
  protocol::Limits limits;
  limits.messages_per_s = messages_per_s;
  limits.burst = burst;
  return limits;
}

Frame key(std::uint64_t index) {
  return {FrameKind::kKey, index, index, index, as_line("key " + std::to_string(index) + "\n")};
}
Frame delta(std::uint64_t index, std::uint64_t base) {
  return {FrameKind::kDelta, index, base, index, as_line("delta " + std::to_string(index) + "\n")};
}

}  // namespace

TEST_CASE("a session says hello first, and all of it") {
  Stage stage;
  stage.start();
  protocol::Hello hello;
  hello.behavior = match::kBehavior;
  hello.server = "woodlouse a.b.c";
  hello.session = core::to_hex(Stage::kId);
  hello.rooms = {"volcano", "meadow"};
  hello.features = {"quantized", "exact",   "fields",   "delta", "get_map", "resume",
                    "rules",     "records", "rotation", "view",  "inputs"};
  CHECK(stage.far->received == text_of(hello));
  CHECK(stage.log.str().empty());
}

TEST_CASE("who watches the rooms hears of each change within a second, once, and need not join") {
  Stage stage;
  stage.start();
  const auto times_told = [&stage] {
    std::size_t times = 0;
    for (std::size_t at = 0; (at = stage.far->received.find("{\"type\":\"rooms\"", at)) != std::string::npos;
         ++at)
      ++times;
    return times;
  };
  stage.send("{\"type\":\"list\",\"watch\":true}\n");
  CHECK(times_told() == 1);
  stage.pass(seconds(3));
  CHECK(times_told() == 1);
  stage.directory.times_changed += 2;  // two rooms at once
  stage.pass(seconds(1));
  CHECK(times_told() == 2);
  stage.pass(seconds(2));
  CHECK(times_told() == 2);
  stage.pass(seconds(stage.limits.handshake_s));
  CHECK_FALSE(stage.has_got("handshake_timeout"));
  stage.send("{\"type\":\"list\"}\n");
  CHECK(times_told() == 3);
  ++stage.directory.times_changed;
  stage.pass(seconds(2));
  CHECK(times_told() == 3);
  stage.pass(seconds(stage.limits.handshake_s));
  CHECK(stage.has_got("handshake_timeout"));
}

TEST_CASE("a session that is refused says why and bye, no hello, and hears nothing") {
  Stage stage;
  stage.start_refused({"too_many_connections", "close one first", true, {}});
  CHECK(stage.far->received ==
        text_of(protocol::ErrorMessage{"too_many_connections", "close one first", true, {}}) +
            text_of(protocol::Bye{"too_many_connections", "close one first", false}));
  CHECK(stage.far->is_shut);
  stage.send(kJoin);
  CHECK(stage.volcano->joins.empty());
  CHECK(stage.log.str() ==
        "info: session 000000000000002a of 10.0.0.1: ended: too_many_connections: close one first\n");
}

TEST_CASE("a join reaches the first room's door, and what follows does with the time it came") {
  Stage stage;
  stage.start_joined();
  REQUIRE(stage.volcano->joins.size() == 1);
  CHECK(stage.volcano->joins[0].name == "ann");
  stage.pass(seconds(2));
  stage.send(kChat);
  REQUIRE(stage.volcano->messages.size() == 1);
  CHECK(std::get<protocol::Chat>(stage.volcano->messages[0].first).text == "hi");
  CHECK(stage.volcano->messages[0].second == stage.timekeeper.now());
  CHECK(stage.meadow->joins.empty());
}

TEST_CASE("a join reaches the door of the room that it names") {
  Stage stage;
  stage.start();
  stage.send("{\"type\":\"join\",\"protocol\":1,\"role\":\"player\",\"name\":\"ann\",\"room\":\"meadow\"}\n");
  CHECK(stage.volcano->joins.empty());
  CHECK(stage.meadow->joins.size() == 1);
}

TEST_CASE("an unknown room is told with the ones there are, and another may be tried") {
  Stage stage;
  stage.start();
  stage.send("{\"type\":\"join\",\"protocol\":1,\"role\":\"player\",\"name\":\"ann\",\"room\":\"moon\"}\n");
  CHECK(stage.last_line() ==
        text_of(protocol::ErrorMessage{
            "unknown_room", "join.room: no room \"moon\"; there are: volcano meadow", false, {}}));
  stage.send(kJoin);
  CHECK(stage.volcano->joins.size() == 1);
}

TEST_CASE("who was refused by the room may try again, and is not in it meanwhile") {
  Stage stage;
  stage.start_joined();
  const protocol::ErrorMessage full{"room_full", "full", false, {}};
  stage.volcano->member->refuse_join(full);
  stage.run();
  CHECK(stage.last_line() == text_of(full));
  stage.send(kChat);
  CHECK(stage.volcano->messages.empty());
  CHECK(stage.has_got("not_joined"));
  stage.send(kJoin);
  CHECK(stage.volcano->joins.size() == 2);
}

TEST_CASE("ping and list are answered without a room") {
  Stage stage;
  stage.start();
  stage.send("{\"type\":\"ping\",\"t\":17}\n");
  CHECK(stage.last_line() == text_of(protocol::Pong{17}));
  stage.send("{\"type\":\"list\"}\n");
  CHECK(stage.last_line() == text_of(stage.directory.list()));
}

TEST_CASE("bytes arrive in whatever pieces") {
  Stage stage;
  stage.start();
  for (const char byte : kJoin) {
    CHECK(stage.volcano->joins.empty());
    stage.send({&byte, 1});
  }
  CHECK(stage.volcano->joins.size() == 1);
  stage.send(std::string(kChat) + std::string(kChat) + std::string(kChat.substr(0, 5)));
  CHECK(stage.volcano->messages.size() == 2);
  stage.send(kChat.substr(5));
  CHECK(stage.volcano->messages.size() == 3);
  CHECK(stage.traffic.lines_received == 4);
}

TEST_CASE("of more lines than go at once the rest waits unread, and all are read to their end") {
  Stage stage(limits_of_rate(60, 10'000));
  stage.start();
  std::string many;
  for (int i = 0; i < 2000; ++i) many += kPing;
  stage.send(many);
  CHECK(stage.traffic.lines_received == 8);
  stage.pass(seconds(1));
  CHECK(stage.traffic.lines_received <= 16);  // time that passes at once makes one pause
  for (int k = 0; k < 2000 / 4 && stage.traffic.lines_received < 2000; ++k) stage.pass(milliseconds(9));
  CHECK(stage.traffic.lines_received == 2000);
  CHECK(stage.lines().size() == 2001);
}

TEST_CASE("a line that is too long ends the session") {
  Stage stage;
  stage.start();
  stage.send(std::string(protocol::kMaxLineBytes + 1, ' ') + '\n');
  CHECK(stage.last_line() ==
        text_of(protocol::Bye{"line_too_long", "a line is longer than 4096 bytes", false}));
}

TEST_CASE("three lines running that are no JSON end the session, and the rest of the bytes is not read") {
  Stage stage;
  stage.start();
  stage.send("rubbish\nrubbish\n");
  CHECK_FALSE(stage.has_got("\"bye\""));
  stage.send("rubbish\n" + std::string(kJoin));
  CHECK(stage.has_got("\"bye\""));
  CHECK(stage.volcano->joins.empty());
}

TEST_CASE("a line past the rate is refused with the time to wait, who waits it out is heard again") {
  Stage stage(limits_of_rate(10, 2));
  stage.start();
  stage.send(std::string(kPing) + std::string(kPing) + std::string(kPing));
  CHECK(stage.last_line() ==
        text_of(protocol::ErrorMessage{"rate_limited", "more than 10 messages a second: this one was dropped",
                                       false, 100}));
  stage.pass(milliseconds(100));
  stage.send(kPing);
  CHECK(stage.last_line() == text_of(protocol::Pong{1}));
}

TEST_CASE("what the system takes at once is one write, the rest of it another, and all arrives in order") {
  Stage stage;
  stage.far->takes_at_once = GENERATE(0u, 1u, 700u, 1'000'000u);
  stage.start_joined();
  stage.volcano->member->deliver(as_line("one\n"));
  stage.volcano->member->show_again(key(1));
  stage.volcano->member->answer(protocol::Pong{3});
  stage.run();
  stage.volcano->member->show(key(2));
  stage.run();
  CHECK(stage.far->received.ends_with("one\n" + text_of(protocol::Pong{3}) + "key 1\nkey 2\n"));
  CHECK(stage.traffic.bytes_sent == stage.far->received.size());
  CHECK(stage.traffic.frames_sent == 2);
  CHECK((stage.far->takes_at_once < 1'000'000 || stage.far->writes == 0));
}

TEST_CASE("who keeps flooding is ended") {
  Stage stage(limits_of_rate(10, 12));
  stage.start_joined();
  for (int i = 0; i < 1000 && stage.volcano->left.empty(); ++i) {
    stage.send(kPing);
    stage.pass(milliseconds(10));
  }
  CHECK(stage.last_line() ==
        text_of(protocol::Bye{"flood", "messages kept coming long after rate_limited", false}));
}

TEST_CASE("one write runs at a time, what is said meanwhile goes out together in its order") {
  Stage stage;
  stage.start_joined();
  stage.far->holds_writes = true;
  const std::size_t before = stage.far->writes;
  const std::size_t seen = stage.lines().size();
  stage.volcano->member->deliver(as_line("one\n"));
  stage.run();
  stage.volcano->member->show_again(key(1));
  stage.volcano->member->deliver(as_line("two\n"));
  stage.volcano->member->deliver_map(as_line("map\n"));
  stage.volcano->member->answer(protocol::Pong{3});
  stage.run();
  CHECK(stage.far->writes == before + 1);
  stage.far->let_go();
  stage.run();
  CHECK(stage.far->writes == before + 2);
  const auto lines = stage.lines();
  const std::vector<std::string> said(lines.begin() + static_cast<std::ptrdiff_t>(seen), lines.end());
  CHECK(said == std::vector<std::string>{"one\n", "two\n", text_of(protocol::Pong{3}), "map\n", "key 1\n"});
  CHECK(stage.traffic.frames_sent == 1);
  CHECK(stage.traffic.bytes_sent == stage.far->received.size());
}

TEST_CASE("a second map is refused while the first one waits") {
  Stage stage;
  stage.start_joined();
  stage.far->holds_writes = true;
  stage.volcano->member->deliver(as_line("busy\n"));
  stage.run();
  stage.volcano->member->deliver_map(as_line("map\n"));
  stage.volcano->member->deliver_map(as_line("map\n"));
  stage.run();
  stage.far->let_go();
  stage.run();
  CHECK(stage.has_got("get_map: the map you asked for is still on its way"));
  CHECK(stage.last_line() == "map\n");
}

TEST_CASE("a client that takes every second frame is shown no others") {
  Stage stage;
  stage.start_joined();
  stage.volcano->member->welcome({}, 2);
  stage.run();
  CHECK(stage.has_got("\"welcome\""));
  for (std::uint64_t index = 10; index < 14; ++index) {
    stage.volcano->member->show(index == 10 ? key(index) : delta(index, 10));
    stage.run();
  }
  CHECK(stage.has_got("key 10\ndelta 12\n"));
  CHECK_FALSE(stage.has_got("delta 11"));
  CHECK_FALSE(stage.has_got("delta 13"));
}

TEST_CASE("more bytes than the outbox holds end the session as slow") {
  protocol::Limits limits;
  limits.outbox_bytes = 2000;
  Stage stage(limits);
  stage.start_joined();
  stage.far->holds_writes = true;
  for (int i = 0; i < 3; ++i) stage.volcano->member->deliver(as_line(std::string(999, 'x') + '\n'));
  stage.run();
  CHECK(stage.volcano->left == std::vector<SessionId>{Stage::kId});
  stage.far->let_go();
  stage.run();
  CHECK(stage.last_line() ==
        text_of(protocol::Bye{"slow", "more than 2000 bytes of events and answers wait for you", false}));
}

TEST_CASE("a client that reads nothing is sent ever less, is told, and is ended as slow") {
  Stage stage;
  stage.start_joined();
  stage.far->holds_writes = true;
  stage.volcano->member->deliver(as_line("stuck\n"));
  std::uint64_t index = 20;
  for (int i = 0; i < 20 * 15 && stage.volcano->left.empty(); ++i, ++index) {
    stage.volcano->member->show(index % 20 == 0 ? key(index) : delta(index, index - index % 20));
    stage.pass(milliseconds(50));
  }
  CHECK(stage.volcano->left.size() == 1);
  stage.far->let_go();
  stage.run();
  CHECK(stage.has_got(text_of(protocol::Notice{
                          "rate_lowered", "you read slower than frames come: half the rate from now on"}) +
                      text_of(protocol::Notice{"keys_only", "you read very slowly: only keys from now on"})));
  CHECK(stage.last_line() ==
        text_of(protocol::Bye{"slow", "you read too slowly, even for keys alone", false}));
  CHECK(stage.log.str() ==
        "info: session 000000000000002a of 10.0.0.1: ended: slow: you read too slowly, even for keys "
        "alone\n");
  CHECK(stage.volcano->parting == Parting::kLost);
}

}  // namespace woodlouse::server::session_test
