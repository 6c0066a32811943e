#include "server/net/handshake.h"

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;
using State = Handshake::State;

namespace {

protocol::Join join(protocol::Role role) {
  protocol::Join message;
  message.name = "mara";
  message.role = role;
  return message;
}

/// What a session does with a message.
std::optional<protocol::ErrorMessage> told(Handshake& handshake, const protocol::ClientMessage& message) {
  auto refusal = handshake.why_not(message);
  if (!refusal) handshake.take(message);
  return refusal;
}

const protocol::DecodeError kNotJson{"bad_json", "not JSON", false};
const protocol::DecodeError kBadField{"bad_field", "input.seq: missing", true};

}  // namespace

TEST_CASE("before the join only join, list, ping, pong and leave are legal") {
  Handshake handshake;
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::List{}}));
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::Ping{1}}));
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::Pong{1}}));
  for (const protocol::ClientMessage& early :
       {protocol::ClientMessage{protocol::Input{}}, protocol::ClientMessage{protocol::Chat{"hi"}},
        protocol::ClientMessage{protocol::GetMap{}}, protocol::ClientMessage{protocol::Resync{}},
        protocol::ClientMessage{protocol::Respawn{}}, protocol::ClientMessage{protocol::ListRecords{}},
        protocol::ClientMessage{protocol::GetGhost{}}}) {
    const auto error = told(handshake, early);
    REQUIRE(error);
    CHECK(error->code == "not_joined");
    CHECK_FALSE(error->fatal);
  }
  CHECK(handshake.state() == State::kGreeting);
}

TEST_CASE("a session joins once, unless the room refused it") {
  Handshake handshake;
  CHECK_FALSE(told(handshake, protocol::ClientMessage{join(protocol::Role::kBot)}));
  CHECK(handshake.state() == State::kPlaying);
  const auto error = told(handshake, protocol::ClientMessage{join(protocol::Role::kBot)});
  REQUIRE(error);
  CHECK(error->code == "already_joined");
  handshake.refused();
  CHECK_FALSE(told(handshake, protocol::ClientMessage{join(protocol::Role::kPlayer)}));
}

TEST_CASE("a player may do everything, a spectator everything that needs no louse") {
  const protocol::Role role =
      GENERATE(protocol::Role::kPlayer, protocol::Role::kBot, protocol::Role::kSpectator);
  Handshake handshake;
  told(handshake, protocol::ClientMessage{join(role)});
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::Chat{"hi"}}));
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::GetMap{}}));
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::Resync{}}));
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::ListRecords{}}));
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::GetGhost{}}));
  const auto input = told(handshake, protocol::ClientMessage{protocol::Input{}});
  const auto respawn = told(handshake, protocol::ClientMessage{protocol::Respawn{}});
  CHECK(input.has_value() == (role == protocol::Role::kSpectator));
  CHECK(respawn.has_value() == (role == protocol::Role::kSpectator));
  if (input) CHECK(input->code == "no_louse");
}

TEST_CASE("leave is the last word") {
  Handshake handshake;
  CHECK_FALSE(told(handshake, protocol::ClientMessage{protocol::Leave{}}));
  CHECK(handshake.state() == State::kLeaving);
}

TEST_CASE("three lines running that are no JSON are hopeless, two and a good one are not") {
  Handshake handshake;
  CHECK_FALSE(handshake.judge(kNotJson).fatal);
  CHECK_FALSE(handshake.judge(kNotJson).fatal);
  told(handshake, protocol::ClientMessage{protocol::Ping{}});
  CHECK_FALSE(handshake.judge(kNotJson).fatal);
  CHECK_FALSE(handshake.judge(kNotJson).fatal);
  CHECK_FALSE(handshake.judge(kBadField).fatal);
  CHECK_FALSE(handshake.judge(kNotJson).fatal);
  CHECK_FALSE(handshake.judge(kNotJson).fatal);
  CHECK(handshake.judge(kNotJson).fatal);
}

TEST_CASE("any number of lines that are JSON but wrong is answered, none is fatal") {
  Handshake handshake;
  for (int i = 0; i < 100; ++i) {
    const protocol::ErrorMessage error = handshake.judge(kBadField);
    REQUIRE_FALSE(error.fatal);
    REQUIRE(error.text == kBadField.text);
  }
}

TEST_CASE("a join of another protocol version is fatal") {
  Handshake handshake;
  CHECK(handshake.judge(protocol::DecodeError{"bad_protocol", "join.protocol is 2", true}).fatal);
}

TEST_CASE("only a line that begins an HTTP request is told where HTTP is spoken") {
  const std::string url = "http://127.0.0.1:7778/";
  for (const auto* line : {"GET / HTTP/1.1", "POST /x HTTP/1.0", "HEAD / HTTP/1.1"}) {
    CHECK(where_http_is(line, url).find(url) != std::string::npos);
    CHECK(where_http_is(line, "").find("--web") != std::string::npos);
  }
  for (const auto* line : {"", "GET", "GET /", "Host: HTTP/1.1", "{\"type\":\"GET / HTTP/1.1\"}"})
    CHECK(where_http_is(line, url).empty());
}
