#include "bench/swarm/line_scan.h"

#include <catch2/catch.hpp>
#include <string>

#include "shared/protocol/codec.h"

namespace protocol = woodlouse::protocol;
using namespace woodlouse::swarm;

namespace {

std::string without_newline(std::string line) {
  line.pop_back();
  return line;
}

}  // namespace

TEST_CASE("an ack as the server writes it gives its seq, cut anywhere it gives none") {
  protocol::Ack ack;
  ack.seq = 4294967295u;
  ack.tick = 812;
  const std::string line = without_newline(protocol::encode(ack));
  CHECK(scan_ack_seq(line) == 4294967295u);
  for (std::size_t size = 0; size < line.size(); ++size) CHECK_FALSE(scan_ack_seq(line.substr(0, size)));
  CHECK_FALSE(scan_ack_seq(R"({"type":"ack","seq":4294967296,"tick":1})"));
  CHECK_FALSE(scan_ack_seq(R"({"type":"ack","seq":-1,"tick":1})"));
}

TEST_CASE("events, maps, rooms and pongs are only counted") {
  CHECK(is_only_counted(without_newline(protocol::encode(protocol::Event{}))));
  CHECK(is_only_counted(without_newline(protocol::encode(protocol::Rooms{}))));
  CHECK(is_only_counted(without_newline(protocol::encode(protocol::ServerMessage(protocol::Pong{5})))));
  CHECK_FALSE(is_only_counted(without_newline(protocol::encode(protocol::ServerMessage(protocol::Ping{5})))));
  CHECK_FALSE(is_only_counted(without_newline(protocol::encode(protocol::Notice{"draining", "soon"}))));
  CHECK_FALSE(is_only_counted(""));
}

TEST_CASE("a welcome without its players says all else it said") {
  protocol::Welcome welcome;
  welcome.id = 7;
  welcome.resume_token = "5d1c0f";
  welcome.room = "volcano";
  welcome.fields = protocol::default_columns();
  const std::string empty = without_newline(protocol::encode(welcome));
  CHECK(without_players(empty) == empty);
  welcome.players = {{3, "bob", protocol::Role::kBot}, {4, "ann", protocol::Role::kPlayer}};
  CHECK(without_players(without_newline(protocol::encode(welcome))) == empty);
  const std::string other = R"({"type":"notice","code":"x","text":"\"players\":[1]"})";
  CHECK(without_players(other) == other);
}

TEST_CASE("a join asks for a token or comes with one") {
  protocol::Join join;
  join.name = "ann";
  const std::string line = protocol::encode(protocol::ClientMessage(join));
  CHECK(with_resume(line, {}) == line.substr(0, line.size() - 2) + ",\"resume\":true}\n");
  CHECK(with_resume(line, "5d1c0f") == line.substr(0, line.size() - 2) + ",\"resume\":\"5d1c0f\"}\n");
}

TEST_CASE("a welcome says whether it resumes") {
  CHECK(says_resumed(R"({"type":"welcome","id":7,"resumed":true,"mode":"roam"})"));
  CHECK_FALSE(says_resumed(R"({"type":"welcome","id":7,"resumed":false,"mode":"roam"})"));
  CHECK_FALSE(says_resumed(R"({"type":"welcome","id":7,"mode":"roam"})"));
}
