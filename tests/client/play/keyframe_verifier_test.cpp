#include "client/play/keyframe_verifier.h"

#include <bit>
#include <catch2/catch.hpp>
#include <functional>
#include <memory>

#include "client/play/join_request.h"
#include "client/play/room_view.h"
#include "shared/map/map_file.h"
#include "shared/match/match.h"
#include "shared/protocol/codec.h"

using namespace woodlouse;
using namespace woodlouse::client;

namespace {

std::vector<double> row_of(const state::Louse& louse) {
  return {static_cast<double>(louse.id),
          static_cast<double>(louse.phase),
          louse.position.x,
          louse.position.y,
          louse.velocity.x,
          louse.velocity.y,
          louse.heading.x,
          louse.heading.y,
          louse.thrust.x,
          louse.thrust.y,
          louse.flight_z,
          louse.flight_vz,
          louse.distance,
          static_cast<double>(louse.thrust_kind),
          static_cast<double>(louse.thrust_ticks)};
}

/// A key as the wire carries it.
std::string key_line(const match::Match& match) {
  std::string line = R"({"type":"key","tick":)" + std::to_string(match.tick()) + R"(,"louse":[)";
  for (const state::Louse& louse : match.world().lice()) {
    line += line.back() == '[' ? "[" : ",[";
    const std::vector<double> row = row_of(louse);
    for (std::size_t i = 0; i < row.size(); ++i) {
      char text[protocol::kValueRoom];
      if (i > 0) line += ',';
      line.append(text,
                  protocol::write_value(text, row[i], protocol::all_columns()[i], protocol::Format::kExact));
    }
    line += ']';
  }
  const state::HashLink& link = match.link();
  return line + R"(],"hash":")" + core::to_hex(match.hash()) + R"(","previous":")" +
         core::to_hex(link.previous) + R"(","inputs":")" + core::to_hex(link.inputs) + R"(","roster":")" +
         core::to_hex(link.roster) + R"(","rules":")" + core::to_hex(link.rules) + R"(","link":)" +
         std::to_string(link.tick) + R"(,"generator":")" + core::to_hex(link.generator) + "\"}\n";
}

protocol::Frame decoded(const std::string& line) {
  const auto message = protocol::decode_server(line, protocol::all_columns(), protocol::Format::kExact);
  if (!message) FAIL(message.error().text);
  return std::get<protocol::Frame>(*message);
}

/// Ten lice that drove for three seconds.
std::unique_ptr<match::Match> played() {
  auto map = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  REQUIRE(map);
  auto match = std::make_unique<match::Match>(*map, match::MatchSettings{60, 7});
  for (int i = 0; i < 10; ++i) match->join();
  for (std::uint32_t tick = 0; tick < 180; ++tick) {
    if (tick % 20 == 1) {
      for (match::PlayerId player = 1; player <= 10; ++player) {
        const double push = (static_cast<int>(player + tick) % 9 - 4) / 4.0;
        match->file({player, tick, {state::ThrustKind::kAlongHeading, {push, 0.0}}, 12 + player, 0});
      }
    }
    match->advance();
  }
  return match;
}

}  // namespace

TEST_CASE("the key of a played match has the hash of its rows") {
  const auto played_match = played();
  const match::Match& match = *played_match;
  const protocol::Frame key = decoded(key_line(match));
  REQUIRE(key.rows() == 10);
  KeyVerifier verifier;
  verifier.take(key);
  CHECK(verifier.verified() == 1);
  CHECK(verifier.hash() == match.hash());
  CHECK_FALSE(verifier.difference());
}

TEST_CASE("one flipped bit in any column of any row is caught and stays known") {
  const protocol::Frame key = decoded(key_line(*played()));
  for (std::size_t place = 0; place < key.values.size(); ++place) {
    protocol::Frame altered = key;
    double& value = altered.values[place];
    const std::size_t column = place % key.columns;
    const bool is_integer = column < 2 || column > 12;
    value = is_integer ? value + 1.0 : std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1u);
    KeyVerifier verifier;
    verifier.take(altered);
    verifier.take(key);
    CAPTURE(place);
    REQUIRE(verifier.difference());
    CHECK(verifier.difference()->tick == key.tick);
    CHECK(verifier.difference()->stated == *key.hash);
    CHECK(verifier.difference()->recomputed != *key.hash);
    CHECK(verifier.verified() == 1);
  }
}

TEST_CASE("one flipped bit in what goes into the hash besides the rows is caught") {
  const protocol::Frame key = decoded(key_line(*played()));
  const std::vector<std::function<void(protocol::Frame&)>> changes = {
      [](protocol::Frame& frame) { frame.proof->previous ^= 1; },
      [](protocol::Frame& frame) { frame.proof->inputs ^= 1u << 31; },
      [](protocol::Frame& frame) { frame.proof->generator ^= std::uint64_t{1} << 63; },
      [](protocol::Frame& frame) { frame.proof->roster ^= 1; },
      [](protocol::Frame& frame) { frame.proof->rules ^= 1; },
      [](protocol::Frame& frame) { frame.proof->tick ^= 1; },
      [](protocol::Frame& frame) { frame.hash = *frame.hash ^ 1; },
      [](protocol::Frame& frame) { frame.values.resize(frame.values.size() - frame.columns); }};
  for (const auto& change : changes) {
    protocol::Frame altered = key;
    change(altered);
    KeyVerifier verifier;
    verifier.take(altered);
    CHECK(verifier.difference());
  }
}

TEST_CASE("before anybody came there is no hash, and a key that shows somebody then is caught") {
  auto map = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  REQUIRE(map);
  match::Match match(*map, {60, 7});
  for (int k = 0; k < 10; ++k) match.advance();
  KeyVerifier verifier;
  const protocol::Frame beginning = decoded(key_line(match));
  verifier.take(beginning);
  CHECK(verifier.verified() == 1);
  for (const auto word : {&state::HashLink::previous, &state::HashLink::inputs, &state::HashLink::roster,
                          &state::HashLink::rules}) {
    protocol::Frame forged = beginning;
    *forged.proof.*word = 1;
    KeyVerifier other;
    other.take(forged);
    CHECK(other.difference());
  }
  protocol::Frame altered = decoded(key_line(*played()));
  altered.proof->tick = 0;
  altered.hash = 0;
  verifier.take(altered);
  CHECK(verifier.difference());
}

TEST_CASE("a room that asked for all in exact format verifies its keys and shows its lice as ever") {
  const auto played_match = played();
  const match::Match& match = *played_match;
  const protocol::Join join = make_join(protocol::Role::kSpectator, "eve", "", Hashes::kVerified);
  CHECK(join.fields == protocol::all_columns());
  CHECK(join.format == protocol::Format::kExact);
  protocol::Welcome welcome;
  welcome.fields = join.fields;
  welcome.format = join.format;
  welcome.map_hash = match.map().hash;
  const core::Time now{std::chrono::seconds(100)};
  RoomView room;
  REQUIRE(room.on_message(welcome, now));
  protocol::Frame key = decoded(key_line(match));
  REQUIRE(room.on_message(key, now));
  room.update(now);
  CHECK(room.verifier().verified() == 1);
  REQUIRE(room.lice().size() == 10);
  const state::Louse& first = match.world().lice().front();
  CHECK(room.lice().at(first.id).sample.position.x == first.position.x);
  CHECK(room.lice().at(first.id).sample.velocity.y == first.velocity.y);
  CHECK(room.lice().at(first.id).sample.distance == first.distance);
  key.tick += 60;
  key.proof->tick += 60;
  REQUIRE(room.on_message(key, now + std::chrono::seconds(1)));
  REQUIRE(room.verifier().difference());
  CHECK(to_text(*room.verifier().difference()).find("state DIFFERS at tick 240: the key says ") == 0);
}
