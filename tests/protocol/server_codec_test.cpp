#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

using namespace woodlouse;
using namespace woodlouse::protocol;

namespace {

std::string line_of(const ServerMessage& message) {
  std::string line = encode(message);
  REQUIRE(line.back() == '\n');
  line.pop_back();
  REQUIRE(line.find('\n') == std::string::npos);
  return line;
}

tl::expected<ServerMessage, DecodeError> decode(const std::string& line) {
  return decode_server(line, default_columns(), Format::kQuantized);
}

std::string refused(const std::string& line, Format format = Format::kQuantized) {
  const auto message = decode_server(line, default_columns(), format);
  INFO(line);
  REQUIRE_FALSE(message);
  CHECK_FALSE(message.error().text.empty());
  return message.error().code;
}

Welcome some_welcome(Format format) {
  Welcome welcome;
  welcome.id = 7;
  welcome.resume_token = "00ff";
  welcome.room = "volcano";
  welcome.tick = 123456789012;
  welcome.fields = {Column::kId, Column::kX, Column::kYaw, Column::kTx, Column::kDistance};
  welcome.format = format;
  if (format == Format::kExact) welcome.view_rows = 30;
  welcome.stream = format == Format::kExact ? Stream::kInputs : Stream::kFrames;
  welcome.map_name = "volcano";
  welcome.map_hash = 0x00123456789abcde;
  welcome.extent = {-20.0, -20.0, 20.0, 20.5};
  welcome.map_bytes = 4321;
  welcome.physics = {9.81, 0.2, 0.05, 4.0, 0.5};
  welcome.mode = "roam";
  welcome.players = {{1, "ann", Role::kPlayer}, {2, "bob\"", Role::kBot}};
  return welcome;
}

}  // namespace

TEST_CASE("an ack's bytes, with a state and without, onto what is there") {
  Ack ack{4294967295, 1234567890123, -250, true, false, true, std::nullopt};
  std::string text = "before ";
  append(text, ack);
  CHECK(text == R"(before {"type":"ack","seq":4294967295,"tick":1234567890123,"margin_us":-250,"late":true,)"
                R"("dropped":false,"clamped":true})"
                "\n");

  ack = {7, 77, 8123, false, true, false, ExactState{78, {}}};
  state::Louse& louse = ack.you->louse;
  louse.id = 17;
  louse.phase = state::Phase::kFlying;
  louse.position = {1.2345678901234567, -9.876543210987654};
  louse.velocity = {1e-300, -0.0};
  louse.heading = {0.6, -0.8};
  louse.thrust = {0.5, -0.2421875};
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.thrust_ticks = state::kHeld;
  louse.flight_z = -1e22;
  louse.flight_vz = 3;
  louse.distance = 123456.7890625;
  CHECK(encode(ack) ==
        R"({"type":"ack","seq":7,"tick":77,"margin_us":8123,"late":false,"dropped":true,"clamped":false,)"
        R"("you":{"tick":78,"id":17,"x":1.2345678901234567,"y":-9.876543210987654,"vx":1e-300,"vy":-0.0,)"
        R"("heading":[0.6,-0.8],"thrust":[0.5,-0.2421875],"thrust_kind":2,"thrust_ticks":4294967295,)"
        R"("phase":2,"flight_z":-1e+22,"flight_vz":3,"distance":123456.7890625}})"
        "\n");
}

TEST_CASE("the longest ack there can be") {
  constexpr double kLongest = -2.2250738585072014e-308;
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  Ack ack{4294967295,           kMost, std::numeric_limits<std::int64_t>::min(), false, false, false,
          ExactState{kMost, {}}};
  state::Louse& louse = ack.you->louse;
  louse.id = louse.thrust_ticks = 4294967295;
  for (core::Vec2* pair : {&louse.position, &louse.velocity, &louse.heading, &louse.thrust})
    *pair = {kLongest, kLongest};
  louse.flight_z = louse.flight_vz = louse.distance = kLongest;
  const std::string line = encode(ack);
  CHECK(std::count(line.begin(), line.end(), 'e') > 11);
  CHECK(line.ends_with("\"distance\":-2.2250738585072014e-308}}\n"));
}

TEST_CASE("an ack carries every field of the louse, bit for bit") {
  for (std::size_t k = 0; k < state::kLouseFields.size(); ++k) {
    const state::LouseField& field = state::kLouseFields[k];
    INFO(field.name);
    Ack ack{5, 77, 0, false, false, false, ExactState{78, {}}};
    ack.you->louse.id = 9;
    const state::Louse plain = ack.you->louse;
    const bool is_kind = state::holds_integer(field) && field.largest == 2;
    state::set_field(ack.you->louse, field,
                     state::holds_integer(field) ? (is_kind ? 2.0 : 12345.0) : -1.0 / 3.0);
    const auto back = decode_server(encode(ServerMessage(ack)), default_columns(), Format::kQuantized);
    REQUIRE(back);
    CHECK(std::memcmp(&std::get<Ack>(*back).you->louse, &ack.you->louse, sizeof(state::Louse)) == 0);
    CHECK_FALSE(ack.you->louse == plain);
  }
}

TEST_CASE("every server message comes back as it was sent") {
  Hello hello{kProtocolVersion, 1, "woodlouse 0.1.0", "9f", {"volcano", "hills"}, {"exact"}, {}};
  hello.hosts = {"10.0.0.6:7777", "[2001:db8::6]:7777", "farm.example:7778"};
  hello.limits.burst = 9;
  Welcome spectator = some_welcome(Format::kExact);
  spectator.id = 0;
  spectator.resume_token.clear();
  spectator.players.clear();
  Ack ack{5, 77, -1500, true, false, true, ExactState{}};
  ack.you->tick = 78;
  ack.you->louse.id = 3;
  ack.you->louse.position = {0.1, -1e-300};
  ack.you->louse.velocity = {1.0 / 3.0, -0.0};
  ack.you->louse.heading = {0.6, 0.8};
  ack.you->louse.thrust = {0.5, -0.25};
  ack.you->louse.thrust_kind = state::ThrustKind::kMapVector;
  ack.you->louse.phase = state::Phase::kFlying;
  ack.you->louse.flight_z = 7.25;
  ack.you->louse.flight_vz = -0.5;
  ack.you->louse.thrust_ticks = 0xffff'ffff;
  ack.you->louse.distance = 123456.789;
  const std::vector<ServerMessage> messages = {
      hello,
      some_welcome(Format::kQuantized),
      some_welcome(Format::kExact),
      spectator,
      ack,
      Ack{0, 0, 0, false, true, false, std::nullopt},
      Event{1, 2, EventKind::kJoined, 3, "ann", Role::kBot, ""},
      Event{2, 2, EventKind::kLeft, 3, "ann", {}, ""},
      Event{3, 9, EventKind::kChat, 0, "eve", {}, "hi \\ \"all\""},
      Event{4, 9, EventKind::kRespawned, 1, "x", {}, ""},
      Notice{std::string(code::kRateLowered), "slow"},
      ErrorMessage{std::string(code::kBadField), "no", false, std::nullopt},
      ErrorMessage{std::string(code::kRateLimited), "slow down", false, 250u},
      ErrorMessage{std::string(code::kMoved), "there", true, std::nullopt, "10.0.0.6:7777"},
      Bye{std::string(code::kShutdown), "", true},
      Bye{std::string(code::kMoved), "there", true, "[2001:db8::6]:7777"},
      Bye{std::string(code::kMoved), "", true, "what is no address is told as well"},
      Rooms{{{"volcano", "volcano", 1, 2, 3, "FKTPZ"}, {"b", "hills", 0, 0, 0, "BXDRM", "10.0.0.6:7777"}}},
      Rooms{{{"of a server that tells no codes", "hills", 0, 0, 0}}},
      Rooms{},
      MapMessage{"volcano", 0xfedcba9876543210,
                 R"({"name":"volcano","terrain":{"heights":[[1,2.50],[3,4e0]]}})"},
      MapMessage{"alps", 7, R"({"name":"alps","terrain":{"file":"alps.flt"}})", true,
                 terrain::HeightGrid{4, 5, -50.0, 0.25, 0.5, 1.0 / 3.0, std::vector<double>(20, -1.5)}},
      Ping{12},
      Ping{13, {{"10.0.0.6:7777", "[2001:db8::6]:7777"}}},
      Ping{14, std::vector<std::string>{}},
      Pong{-12}};
  for (const ServerMessage& message : messages) {
    INFO(line_of(message));
    const auto back = decode(line_of(message));
    if (!back) FAIL(back.error().text);
    CHECK(*back == message);
  }
}

TEST_CASE("a minus zero keeps its sign, for the state hash's sake") {
  Ack ack;
  ack.you = ExactState{};
  ack.you->louse.id = 1;
  ack.you->louse.velocity = {-0.0, 0.0};
  const auto back = decode(line_of(ack));
  REQUIRE(back);
  CHECK(std::signbit(std::get<Ack>(*back).you->louse.velocity.x));
  CHECK_FALSE(std::signbit(std::get<Ack>(*back).you->louse.velocity.y));
}

TEST_CASE("a map's definition comes back byte for byte, with knots or without, whatever stands around it") {
  const MapMessage map{"m", 1,
                       R"({"name":"a \"definition\":{ ]","physics":{"drag":0.20},"terrain":[[1,2],[3,4]]})"};
  const std::string knots =
      R"({"origin":[0,0],"spacing":[1,1],"columns":2,"rows":2,"heights":[[1,2],[3,4]]})";
  MapMessage drawn = map;
  drawn.knots = terrain::HeightGrid{2, 2, 0.0, 0.0, 1.0, 1.0, {1.0, 2.0, 3.0, 4.0}};
  for (const MapMessage& message : {map, drawn}) {
    const auto back = decode(line_of(message));
    REQUIRE(back);
    CHECK(std::get<MapMessage>(*back) == map);
  }
  CHECK(line_of(drawn).find(",\"knots\":" + knots + "}") != std::string::npos);
  const auto shuffled =
      decode(R"({ "x":"definition", "definition" : {"a":{"definition":1}} ,"hash":"0000000000000001",)"
             R"("name":"m","type":"map"})");
  REQUIRE(shuffled);
  CHECK(std::get<MapMessage>(*shuffled).definition == R"({"a":{"definition":1}})");
  const auto escaped =
      decode(R"({"type":"map","name":"m","hash":"0000000000000001","\u0064efinition":{"a":1.50}})");
  REQUIRE(escaped);
  CHECK(std::get<MapMessage>(*escaped).definition == R"({"a":1.50})");
  CHECK(refused(R"({"type":"map","name":"m","hash":"0000000000000001","definition":[]})") == code::kBadField);
}

TEST_CASE("an overview that is not what it says is refused with the field's name") {
  const auto text_of = [](const std::string& knots) {
    const auto back =
        decode(R"({"type":"map","name":"m","hash":"0000000000000001","definition":{},"overview":true)" +
               knots + "}");
    return back ? std::string() : back.error().text;
  };
  const auto knots = [](const std::string& spacing, int columns, int rows,
                        const std::string& row = "[0,1,2,3]") {
    std::string text = R"(,"knots":{"origin":[0,0],"spacing":)" + spacing + R"(,"columns":)" +
                       std::to_string(columns) + R"(,"rows":4,"heights":[)" + row;
    for (int k = 1; k < rows; ++k) text += "," + row;
    return text + "]}";
  };
  CHECK(text_of(knots("[1,1]", 4, 4)).empty());
  CHECK(text_of("").find("map.knots") == 0);
  CHECK(text_of(knots("[1,0]", 4, 4)).find("map.knots.spacing") == 0);
  CHECK(text_of(knots("[1,1]", 3, 4)).find("map.knots.columns") == 0);
  CHECK(text_of(knots("[1,1]", 258, 4)).find("map.knots.columns") == 0);
  CHECK(text_of(knots("[1,1]", 4, 3)).find("map.knots.heights") == 0);
  CHECK(text_of(knots("[1,1]", 4, 5)).find("map.knots.heights[4]") == 0);
  CHECK(text_of(knots("[1,1]", 5, 4)).find("map.knots.heights[0]") == 0);
  CHECK(text_of(knots("[1,1]", 4, 4, R"([0,1,2,"3"])")).find("map.knots.heights[0]") == 0);
  CHECK(text_of(knots("[1,1]", 4, 4, "7")).find("map.knots.heights[0]") == 0);
}

TEST_CASE("strings that are not UTF-8 or hold control characters still make a line of JSON") {
  const auto back =
      decode(line_of(ErrorMessage{"bad_field", "a\xff\x01\x1b[2J\n\"b\\", false, std::nullopt}));
  REQUIRE(back);
  CHECK(std::get<ErrorMessage>(*back).text == "a\ufffd[2J \"b\\");
}

TEST_CASE("a client does not trust what it is told to show") {
  const auto back = decode(
      R"({"type":"event","n":1,"tick":1,"kind":"chat","id":1,"name":"\u001b]0;x\u0007","text":"\u202eab"})");
  REQUIRE(back);
  CHECK(std::get<Event>(*back).name == "]0;x");
  CHECK(std::get<Event>(*back).text == "ab");
}

TEST_CASE("server lines out of shape are refused with the code that says why") {
  CHECK(refused("") == code::kBadJson);
  CHECK(refused("[]") == code::kNotAnObject);
  CHECK(refused(R"({"type":"frame"})") == code::kUnknownType);
  CHECK(refused(R"({"type":"error","code":"x","code":"y","text":"","fatal":false})") == code::kDuplicateKey);
  CHECK(refused(R"({"type":"bye","code":"x","text":"","x":[[[[[[[[]]]]]]]]})") == code::kTooDeep);
  CHECK(refused(R"({"type":"bye","code":"x","text":""})") == code::kMissingField);
  CHECK(refused(R"({"type":"bye","code":"x","text":"","resumable":0})") == code::kBadField);
  CHECK(refused(R"({"type":"bye","code":"moved","text":"","resumable":true,"address":7777})") ==
        code::kBadField);
  CHECK(refused(R"({"type":"bye","code":"moved","text":"","resumable":true,"address":")" +
                std::string(262, 'a') + R"("})") == code::kBadField);
  CHECK(refused(R"({"type":"event","n":1,"tick":1,"kind":"eclipse","id":1,"name":""})") ==
        code::kUnknownType);
  CHECK(refused(R"({"type":"event","n":0,"tick":1,"kind":"left","id":1,"name":""})") == code::kBadField);
}

TEST_CASE("a welcome whose columns, quanta or extent make no sense is refused") {
  const std::string good = line_of(some_welcome(Format::kQuantized));
  REQUIRE(decode(good));
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string line = good;
    REQUIRE(line.find(from) != std::string::npos);
    return line.replace(line.find(from), from.size(), to);
  };
  CHECK(refused(with("[\"id\",", "[\"z\",")) == code::kBadField);
  CHECK(refused(with("\"yaw\"", "\"id\"")) == code::kBadField);
  CHECK(refused(with("\"yaw\"", "\"height\"")) == code::kBadField);
  CHECK(refused(with("\"quantum\":[1,", "\"quantum\":[2,")) == code::kBadField);
  CHECK(refused(with("\"quantum\":[1,", "\"quantum\":[")) == code::kBadField);
  CHECK(refused(with("[-20,-20,20,20.5]", "[20,-20,-20,20.5]")) == code::kBadField);
  CHECK(refused(with("[-20,-20,20,20.5]", "[20]")) == code::kBadField);
  CHECK(refused(with("\"00123456789abcde\"", "\"123\"")) == code::kBadField);
  CHECK(refused(with("\"00123456789abcde\"", "\"00123456789ABCDE\"")) == code::kBadField);
  CHECK(refused(with("\"tick_hz\":60", "\"tick_hz\":0")) == code::kBadField);
  CHECK(refused(with("\"gravity\":9.81", "\"gravity\":\"9.81\"")) == code::kBadField);
  CHECK(refused(with("\"role\":\"bot\"", "\"role\":\"king\"")) == code::kBadField);
}

TEST_CASE("frames out of shape are refused") {
  const auto key = [](const std::string& rows) {
    return R"({"type":"key","tick":1,"louse":)" + rows + R"(,"hash":"0000000000000000"})";
  };
  REQUIRE(decode(key("[[1,2,3,4,5]]")));
  REQUIRE(decode(key("[]")));
  CHECK(refused(key("[[1,2,3,4]]")) == code::kBadField);
  CHECK(refused(key("[[1,2,3,4,5,6]]")) == code::kBadField);
  CHECK(refused(key("[1,2,3,4,5]")) == code::kBadField);
  CHECK(refused(key("{}")) == code::kBadField);
  CHECK(refused(key("[[1,2.5,3,4,5]]")) == code::kBadField);
  CHECK(refused(key("[[0,2,3,4,5]]")) == code::kBadField);
  CHECK(refused(key("[[1.5,2,3,4,5]]"), Format::kExact) == code::kBadField);
  CHECK(refused(key("[[1,null,3,4,5]]"), Format::kExact) == code::kBadField);
  CHECK(refused(key("[[4294967296,2,3,4,5]]")) == code::kBadField);
  CHECK(refused(R"({"type":"key","tick":1,"louse":[]})") == code::kMissingField);
  CHECK(refused(R"({"type":"delta","tick":5,"base":6,"louse":[]})") == code::kBadField);
  CHECK(refused(R"({"type":"delta","tick":5,"louse":[]})") == code::kMissingField);
  CHECK(refused(R"({"type":"delta","tick":5,"base":5,"louse":[],"gone":[0]})") == code::kBadField);
  CHECK(decode_server(key("[]"), {}, Format::kExact).error().code == code::kNotJoined);
}
