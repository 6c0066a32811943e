// What a session may ask for, and what happens past that.
#include "server/net/allowance.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <variant>

#include "tests/server/net/session_stage.h"

namespace woodlouse::server::allowance_test {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {
constexpr std::string_view kChat = "{\"type\":\"chat\",\"text\":\"hi\"}\n";
}

TEST_CASE("what goes out to a room has a budget of the session and one of its address") {
  protocol::Limits limits;
  limits.chat_per_s = 1;
  limits.chat_per_s_address = 2;
  limits.messages_per_s = 1200;  // so many lines may come at once
  limits.respawn_per_s = 1;
  Stage stage(limits);
  stage.start_joined();
  for (std::uint32_t k = 0; k < protocol::kSavedSeconds + 3; ++k) stage.send(kChat);
  CHECK(stage.volcano->messages.size() == protocol::kSavedSeconds);
  CHECK(stage.last_line().find("\"retry_after_ms\":1000") != std::string::npos);
  // Others of that address talk too: what they use up is gone for this one.
  stage.address->charge(Spending::kChat, 2.0 * protocol::kSavedSeconds, stage.timekeeper.now());
  stage.pass(seconds(2));
  stage.send(kChat);
  CHECK(stage.volcano->messages.size() == protocol::kSavedSeconds);
  stage.pass(seconds(4));
  stage.send(kChat);
  CHECK(stage.volcano->messages.size() == protocol::kSavedSeconds + 1);
  stage.send("{\"type\":\"respawn\"}\n");
  CHECK(stage.volcano->messages.size() == protocol::kSavedSeconds + 2);
}

TEST_CASE("joins are counted by address, and one that is too many may be tried again") {
  protocol::Limits limits;
  limits.join_per_s_address = 1;
  Stage stage(limits);
  stage.start();
  stage.address->charge(Spending::kJoin, protocol::kSavedSeconds, stage.timekeeper.now());
  stage.send(kJoin);
  CHECK(stage.volcano->joins.empty());
  CHECK(stage.last_line().find("rate_limited") != std::string::npos);
  stage.pass(seconds(1));
  stage.send(kJoin);
  CHECK(stage.volcano->joins.size() == 1);
}

TEST_CASE("answers of too many bytes come late, one of each kind waits, and a list is refused") {
  protocol::Limits limits;
  limits.answer_bytes_per_s = 1000;
  Stage stage(limits);
  stage.start_joined();
  protocol::Welcome welcome;
  welcome.map_bytes = 11'000;
  stage.volcano->member->welcome(welcome, 1);
  stage.run();
  // In one breath, nothing of it answered yet: 8,000 saved, 3,000 owed by the first.
  stage.send(
      "{\"type\":\"get_map\"}\n"
      "{\"type\":\"get_map\"}\n{\"type\":\"resync\"}\n{\"type\":\"get_map\"}\n{\"type\":\"list\"}\n");
  CHECK(stage.volcano->messages.size() == 1);
  CHECK(stage.has_got("you have asked for it already"));
  CHECK_FALSE(stage.has_got("\"rooms\","));
  stage.pass(seconds(3) - milliseconds(1));
  CHECK(stage.volcano->messages.size() == 1);
  stage.pass(milliseconds(2));
  CHECK(stage.volcano->messages.size() == 2);
  stage.pass(seconds(11));  // for the second map
  CHECK(stage.volcano->messages.size() == 3);
}

TEST_CASE("records and ghosts are paid for by what the longest took") {
  protocol::Limits limits;
  limits.answer_bytes_per_s = 4096;
  Stage stage(limits);
  stage.start_joined();
  const auto asked = [&stage] { return stage.volcano->messages.size(); };
  stage.send("{\"type\":\"list_records\"}\n{\"type\":\"list_records\"}\n{\"type\":\"get_ghost\"}\n");
  CHECK(asked() == 3);  // 32,768 saved, guesses of 4,096 and 16,384
  stage.volcano->member->deliver_record(
      Line(R"({"type":"ghost","inputs":")" + std::string(60'000, 'x') + "\"}\n"));
  stage.run();
  CHECK(stage.has_got("\"inputs\""));
  stage.send("{\"type\":\"get_ghost\"}\n{\"type\":\"get_ghost\"}\n{\"type\":\"get_ghost\"}\n");
  CHECK(asked() == 4);
  CHECK(stage.has_got("you have asked for it already"));
  stage.pass(seconds(16));  // one is paid
  CHECK(asked() == 5);
}

TEST_CASE("who leaves while answers wait is told that they are left out") {
  protocol::Limits limits;
  limits.answer_bytes_per_s = 1000;
  Stage stage(limits);
  stage.start_joined();
  stage.address->charge(Spending::kAnswerBytes, 1e9, stage.timekeeper.now());
  stage.send("{\"type\":\"get_map\"}\n{\"type\":\"resync\"}\n{\"type\":\"leave\"}\n");
  REQUIRE(stage.volcano->messages.size() == 1);
  CHECK(std::holds_alternative<protocol::Leave>(stage.volcano->messages[0].first));
  const auto lines = stage.lines();
  CHECK(std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
          return line.find("what you asked for is left out") != std::string::npos;
        }) == 2);
}

TEST_CASE(
    "lines of too many bytes are read late, by the session's measure and its address's, and none is lost") {
  protocol::Limits limits;
  limits.messages_per_s = 100000;
  limits.burst = 100000;
  limits.line_bytes_per_s = 1024;
  const std::string chat = "{\"type\":\"ping\",\"t\":1,\"x\":\"" + std::string(995, 'x') + "\"}\n";
  REQUIRE(chat.size() == 1024);
  Stage stage(limits);
  stage.start_joined();
  const auto pongs = [&] {
    const auto lines = stage.lines();
    return std::count_if(lines.begin(), lines.end(),
                         [](const std::string& line) { return line.find("pong") != std::string::npos; });
  };
  std::string many;
  for (int k = 0; k < 20; ++k) many += chat;
  stage.send(many);
  const auto at_once = pongs();
  CHECK((at_once >= 7 && at_once <= 8));
  stage.pass(milliseconds(3500));
  CHECK((pongs() >= at_once + 3 && pongs() <= at_once + 4));
  // The others of that address send so much that it takes six seconds to make up for.
  const double saved_and_more = (protocol::kSavedSeconds + 6.0) * limits.line_bytes_per_s_address;
  stage.address->charge(Spending::kLineBytes, saved_and_more, stage.timekeeper.now());
  const auto before = pongs();
  stage.pass(seconds(5));
  CHECK(pongs() == before);
  stage.pass(seconds(20));
  CHECK(pongs() == 20);
}

}  // namespace woodlouse::server::allowance_test
