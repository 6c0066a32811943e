#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "shared/protocol/codec.h"

using namespace woodlouse;
using namespace woodlouse::protocol;

namespace {

ClientMessage decoded(const std::string& line) {
  auto message = decode_client(line);
  INFO(line);
  if (!message) FAIL(message.error().code << ": " << message.error().text);
  return *message;
}

Join joined(const std::string& members) {
  return std::get<Join>(decoded(R"({"type":"join","protocol":1,"name":"ann")" + members + "}"));
}

/// Without the newline that encode() ends with.
std::string line_of(const ClientMessage& message) {
  std::string line = encode(message);
  REQUIRE(line.back() == '\n');
  line.pop_back();
  REQUIRE(line.find('\n') == std::string::npos);
  return line;
}

}  // namespace

TEST_CASE("every client message comes back as it was sent") {
  Join join{kProtocolVersion, Role::kBot, "Zoë \"x\" \\ 木", "wavy", all_columns(), Format::kExact, 10u};
  Join plain;
  plain.name = "n";
  plain.fields = default_columns();
  Input number{7, {state::ThrustKind::kAlongHeading, {0.5, 0.0}}, false, std::nullopt, std::nullopt};
  Input pair{0xffff'ffff,
             {state::ThrustKind::kMapVector, {-0.25, 0.75}},
             false,
             kMaxThrustTicks,
             std::uint64_t{1} << 53};
  Join hopeful = plain;
  hopeful.may_resume = true;
  Join back = hopeful;
  back.resume = "5d1c0f";
  Join watcher = plain;
  watcher.role = Role::kSpectator;
  watcher.stream = Stream::kInputs;
  Join known = plain;
  known.token = "correct-horse \" \\";
  Join looking = plain;
  looking.view = View{{}, 7u, 8.5, 30u};
  Join capped = plain;
  capped.view = View{};
  const std::vector<ClientMessage> messages = {looking,
                                               capped,
                                               Look{},
                                               Look{{woodlouse::core::Vec2{-1.5, 2.0}, {}, 0.25, {}}},
                                               hopeful,
                                               watcher,
                                               back,
                                               known,
                                               join,
                                               plain,
                                               number,
                                               pair,
                                               Chat{"hello, you"},
                                               List{},
                                               List{true},
                                               GetMap{},
                                               Resync{},
                                               Respawn{},
                                               Leave{},
                                               Ping{kMaxInteger},
                                               Ping{-kMaxInteger},
                                               Pong{0},
                                               ListRecords{},
                                               ListRecords{Board::kHandedIn},
                                               GetGhost{},
                                               GetGhost{Board::kBots, 100},
                                               Moderate{"kick", "ann", "", {}},
                                               Moderate{"mute", "ann", "", 60},
                                               Moderate{"say", "", "hello, all", {}}};
  for (const ClientMessage& message : messages) {
    INFO(line_of(message));
    CHECK(decoded(line_of(message)) == message);
  }
}

TEST_CASE("an error about a token does not say which") {
  for (const std::string& token :
       {std::string("7777777"), "\"" + std::string(257, 's') + "\"", std::string("\"\"")}) {
    const auto refused = decode_client(R"({"type":"join","protocol":1,"name":"ann","token":)" + token + "}");
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == "bad_field");
    CHECK(refused.error().text == "join.token must be a password of the server, of 1 to 256 bytes");
  }
}

TEST_CASE("a moderator says what to do, and about whom") {
  CHECK_FALSE(decode_client(R"({"type":"moderate"})"));
  CHECK_FALSE(decode_client(R"({"type":"moderate","action":"ban","who":"ann"})"));
  CHECK_FALSE(decode_client(R"({"type":"moderate","action":"kick"})"));
  CHECK_FALSE(decode_client(R"({"type":"moderate","action":"say"})"));
  CHECK_FALSE(decode_client(R"({"type":"moderate","action":"mute","who":"ann","seconds":0})"));
}

TEST_CASE("a join needs only protocol and name") {
  const Join join = joined("");
  CHECK(join.role == Role::kPlayer);
  CHECK(join.name == "ann");
  CHECK(join.room.empty());
  CHECK(join.fields == default_columns());
  CHECK(join.format == Format::kQuantized);
  CHECK_FALSE(join.state_hz);
}

TEST_CASE("columns are taken in the order asked, with id first") {
  using C = Column;
  CHECK(joined(R"(,"fields":["z","x"])").fields == std::vector<C>{C::kId, C::kZ, C::kX});
  CHECK(joined(R"(,"fields":["speed","id"])").fields == std::vector<C>{C::kId, C::kSpeed});
  CHECK(joined(R"(,"fields":[])").fields == std::vector<C>{C::kId});
  CHECK(joined(R"(,"fields":"all")").fields == all_columns());
}

TEST_CASE("every column can be asked for by its name") {
  std::string names;
  for (std::size_t i = 0; i < kColumnCount; ++i) {
    const auto column = static_cast<Column>(i);
    CHECK(column_from_text(to_text(column)) == column);
    names += (i > 0 ? ",\"" : "\"") + std::string(to_text(column)) + "\"";
  }
  CHECK(joined(",\"fields\":[" + names + "]").fields.size() == kColumnCount);
}

TEST_CASE("unknown fields are passed over, whatever they hold") {
  CHECK(joined(R"(,"later":null,"future":{"a":[1,{"b":[]}],"c":1e5})").name == "ann");
  CHECK(std::holds_alternative<List>(
      decoded(R"({"x":-1.5e-3,"type":"list","y":[[],{},true,false,"\u00e9"]})")));
}

TEST_CASE("the order of fields and white space do not matter") {
  const auto message = decoded(" {\"thrust\" : [ 1 , 0 ] ,\t\"seq\":3, \"type\":\"input\" } \r");
  CHECK(std::get<Input>(message).seq == 3);
  CHECK(std::get<Input>(message).thrust.kind == state::ThrustKind::kMapVector);
}

TEST_CASE("names and chat are cleaned and cut") {
  CHECK(std::get<Join>(decoded(R"({"type":"join","protocol":1,"name":"\u001b[2J  an\u202en\n"})")).name ==
        "[2J ann");
  CHECK(std::get<Join>(decoded(R"({"type":"join","protocol":1,"name":")" + std::string(100, 'a') + "\"}"))
            .name == std::string(kMaxNameBytes, 'a'));
  CHECK(std::get<Chat>(decoded(R"({"type":"chat","text":")" + std::string(900, 'b') + "\"}")).text ==
        std::string(kMaxChatBytes, 'b'));
}

TEST_CASE("the largest lawful message of each kind fits a line") {
  Join join{kProtocolVersion,
            Role::kSpectator,
            std::string(kMaxNameBytes, 'n'),
            std::string(kMaxRoomBytes, 'r'),
            {},
            Format::kQuantized,
            kMaxStateHz,
            true,
            std::string(kMaxTokenBytes, 't')};
  for (std::size_t i = 0; i < kColumnCount; ++i) join.fields.push_back(static_cast<Column>(i));
  CHECK(line_of(join).size() <= kMaxLineBytes);
  CHECK(line_of(Chat{std::string(kMaxChatBytes, '"')}).size() <= kMaxLineBytes);
}
