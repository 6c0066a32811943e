#include "shared/protocol/records.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

using namespace woodlouse;
using namespace woodlouse::protocol;

namespace {

RecordRun some_run() { return {Board::kBots, "r\xc3\xb6lf", Role::kBot, 40, {10, 25, 40}, 1'767'225'600}; }

GhostLine some_ghost() {
  GhostLine line{some_run(), 7, 10, 120, {3, 99, {}}};
  line.ghost.inputs = {{0, {state::ThrustKind::kMapVector, {0.5, -0.0}}, state::kHeld},
                       {0, {state::ThrustKind::kAlongHeading, {-1.0, 0.0}}, 1},
                       {98, {}, 12}};
  return line;
}

tl::expected<ServerMessage, DecodeError> records_decoded(const std::string& line) {
  return decode_server(line, {}, Format::kQuantized);
}

/// The code of a ghost's line in which a part is another.
std::string code_with(const std::string& part, const std::string& other) {
  std::string line = encode(some_ghost());
  const std::size_t at = line.find(part);
  REQUIRE(at != std::string::npos);
  line.replace(at, part.size(), other);
  const auto message = records_decoded(line);
  return message ? "taken" : message.error().code;
}

}  // namespace

TEST_CASE("records and ghosts come back as they were sent, a minus zero with its sign") {
  const Records records{Board::kHandedIn, 30, {{1, some_run()}, {2, {}}}};
  for (const ServerMessage& message : {ServerMessage{records}, ServerMessage{Records{}},
                                       ServerMessage{some_ghost()}, ServerMessage{GhostLine{}}}) {
    INFO(encode(message));
    const auto back = records_decoded(encode(message));
    if (!back) FAIL(back.error().text);
    CHECK(*back == message);
  }
  const auto back = records_decoded(encode(some_ghost()));
  CHECK(std::signbit(std::get<GhostLine>(*back).ghost.inputs[0].thrust.value.y));
}

TEST_CASE("a record's event says on which board") {
  Event event;
  event.n = 4;
  event.kind = EventKind::kRecord;
  event.id = 7;
  event.name = "ann";
  event.moment = 99;
  event.values = {40, 1, std::nullopt, std::nullopt};
  const std::string line = encode(event);
  CHECK(line.find(R"("kind":"record","id":7,"name":"ann","moment":99,"time":40,"bots":1})") !=
        std::string::npos);
  CHECK(records_decoded(line) == ServerMessage{event});
}

TEST_CASE("a ghost's line out of shape is refused") {
  CHECK(code_with("\"bots\"", "\"bots\"") == "taken");
  CHECK(code_with("\"bots\"", "\"cats\"") == code::kBadField);
  CHECK(code_with("[10,25,40]", "[10,-25,40]") == code::kBadField);
  CHECK(code_with("[10,25,40]", "[10,2.5,40]") == code::kBadField);
  CHECK(code_with("[98,0,", "[98,3,") == code::kBadField);
  CHECK(code_with("[98,0,", "[-1,0,") == code::kBadField);
  CHECK(code_with("[98,0,", "[98,0,0,") == code::kBadField);
  CHECK(code_with("\"spawn\":3,", "") == code::kMissingField);
  CHECK(code_with("\"tick_hz\":120", "\"tick_hz\":0") == code::kBadField);
  std::string many = "[[0,0,0,0,1]";
  for (std::size_t k = 0; k < state::kMostGhostInputs; ++k) many += ",[0,0,0,0,1]";
  CHECK(code_with("\"inputs\":[", "\"inputs\":" + many + "],\"more\":[") == code::kBadField);
}

TEST_CASE("what is asked of a board has its first row and people's board by default") {
  CHECK(decode_client(R"({"type":"list_records"})") == ClientMessage{ListRecords{}});
  CHECK(decode_client(R"({"type":"get_ghost","board":"handed_in"})") ==
        ClientMessage{GetGhost{Board::kHandedIn, 1}});
  for (const char* line : {R"({"type":"get_ghost","rank":0})", R"({"type":"get_ghost","rank":101})",
                           R"({"type":"list_records","board":"all"})"})
    CHECK(decode_client(line).error().code == code::kBadField);
}
