// Every line that is refused: with which code, and that its text names the field, what stood there and what
// may.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

using namespace woodlouse::protocol;

namespace {

struct Refusal {
  std::string line;
  std::string_view code;
  std::vector<std::string> text_has;
};

void check(const std::vector<Refusal>& refusals) {
  for (const Refusal& refusal : refusals) {
    INFO(refusal.line);
    const auto message = decode_client(refusal.line);
    REQUIRE_FALSE(message);
    INFO(message.error().text);
    CHECK(message.error().code == refusal.code);
    CHECK(message.error().is_json == (refusal.code != code::kBadJson));
    for (const std::string& part : refusal.text_has)
      CHECK(message.error().text.find(part) != std::string::npos);
  }
}

std::string input(const std::string& members) { return R"({"type":"input",)" + members + "}"; }
std::string join(const std::string& members) { return R"({"type":"join",)" + members + "}"; }

}  // namespace

TEST_CASE("what is not JSON is refused as bad_json") {
  using namespace std::string_literals;
  std::vector<Refusal> refusals;
  for (const std::string& line : {""s,
                                  " "s,
                                  "hello"s,
                                  "{"s,
                                  "}"s,
                                  R"({"type":"list")"s,
                                  R"({"type":"list"}})"s,
                                  R"({"type":"list"} x)"s,
                                  R"({"type":"list",})"s,
                                  R"({'type':'list'})"s,
                                  R"({type:"list"})"s,
                                  R"({"a":NaN})"s,
                                  R"({"a":Infinity})"s,
                                  R"({"a":-Infinity})"s,
                                  R"({"a":01})"s,
                                  R"({"a":+1})"s,
                                  R"({"a":.5})"s,
                                  R"({"a":1.})"s,
                                  R"({"a":0x1})"s,
                                  R"({"a":"\x41"})"s,
                                  R"({"a":"\ud800"})"s,
                                  "{\"a\":\"\xff\"}"s,
                                  "{\"a\":\"\xc0\xaf\"}"s,
                                  "{\"a\":\"\xed\xa0\x80\"}"s,
                                  "{\"a\":\"tab\there\"}"s,
                                  R"({"type":"list"} // note)"s,
                                  "GET / HTTP/1.1"s,
                                  "\x16\x03\x01"s}) {
    refusals.push_back({line, code::kBadJson, {"not JSON at byte"}});
  }
  refusals.push_back({R"({"a":1e999})", code::kBadJson, {"1e999", "too large"}});
  refusals.push_back({"{\"type\":\"list\"}\0{\"type\":\"leave\"}"s, code::kBadJson, {"NUL"}});
  check(refusals);
}

TEST_CASE("JSON that is no object is refused as such") {
  for (const std::string line : {"[]", "1", "-1.5", "\"list\"", "null", "true", R"([{"type":"list"}])"}) {
    check({{line, code::kNotAnObject, {"one JSON object"}}});
  }
}

TEST_CASE("a key that stands twice is refused, at any depth") {
  check({{R"({"type":"list","type":"list"})", code::kDuplicateKey, {"\"type\""}},
         {R"({"type":"list","x":[{"aa":1,"b":2,"aa":3}]})", code::kDuplicateKey, {"\"aa\""}},
         {R"({"type":"list","a":1,"\u0061":2})", code::kDuplicateKey, {"\"a\""}}});
  CHECK(decode_client(R"({"type":"list","a":{"k":1},"b":{"k":1},"k":1})"));
}

TEST_CASE("nesting of 8 passes and of 9 is refused") {
  const auto nested = [](int depth) {
    const auto n = static_cast<std::size_t>(depth - 1);
    return R"({"type":"list","x":)" + std::string(n, '[') + std::string(n, ']') + "}";
  };
  CHECK(decode_client(nested(kMaxDepth)));
  check({{nested(kMaxDepth + 1), code::kTooDeep, {"8"}}, {nested(2000), code::kTooDeep, {}}});
}

TEST_CASE("an unknown type is answered with those there are") {
  check({{R"({"type":"jion"})",
          code::kUnknownType,
          {"\"jion\"", "join", "input", "chat", "resync", "leave", "ping"}},
         {R"({"type":""})", code::kUnknownType, {}},
         {R"({"type":"hello"})", code::kUnknownType, {}},
         {R"({})", code::kMissingField, {"type", "join"}},
         {R"({"Type":"list"})", code::kMissingField, {"type"}},
         {R"({"type":1})", code::kBadField, {"type is 1", "string"}},
         {R"({"type":null})", code::kBadField, {"null"}}});
}

TEST_CASE("missing fields are named with what they are") {
  check({{join(R"("name":"a")"), code::kMissingField, {"join.protocol", "integer"}},
         {join(R"("protocol":1)"), code::kMissingField, {"join.name", "1 to 24 bytes"}},
         {input(R"("thrust":1)"), code::kMissingField, {"input.seq", "0 to 4294967295"}},
         {input(R"("seq":1)"), code::kMissingField, {"input.thrust", "-1 to 1", "pair"}},
         {R"({"type":"chat"})", code::kMissingField, {"chat.text"}},
         {R"({"type":"ping"})", code::kMissingField, {"ping.t"}}});
}

TEST_CASE("a view is refused with the field that is wrong") {
  const auto joined = [](const std::string& view) {
    return join(R"("protocol":1,"name":"a","view":)" + view);
  };
  check({{joined("3"), code::kBadField, {"join.view", "an object"}},
         {joined("null"), code::kBadField, {"join.view", "an object"}},
         {joined(R"({"x":1})"), code::kMissingField, {"join.view.y"}},
         {joined(R"({"y":1})"), code::kMissingField, {"join.view.x"}},
         {joined(R"({"x":1,"y":"2"})"), code::kBadField, {"join.view.y", "\"2\""}},
         {joined(R"({"x":1,"y":2,"louse":3})"), code::kBadField, {"join.view.louse", "left out"}},
         {joined(R"({"radius":0})"), code::kBadField, {"join.view.radius", "above 0"}},
         {joined(R"({"radius":-1e-9})"), code::kBadField, {"join.view.radius", "above 0"}},
         {joined(R"({"rows":0})"), code::kBadField, {"join.view.rows", "1"}},
         {joined(R"({"rows":2.5})"), code::kBadField, {"join.view.rows"}},
         {R"({"type":"view","louse":0})", code::kBadField, {"view.louse", "1"}},
         {R"({"type":"view","rows":1000001})", code::kBadField, {"view.rows", "1000000"}}});
}

TEST_CASE("another protocol is refused before anything else of the join is looked at") {
  check({{join(R"("protocol":2,"name":5,"role":"king")"), code::kBadProtocol, {"2", "speaks 1"}},
         {join(R"("protocol":0,"name":"a")"), code::kBadProtocol, {}},
         {join(R"("protocol":"1","name":"a")"), code::kBadField, {"join.protocol"}},
         {join(R"("protocol":1.0,"name":"a")"), code::kBadField, {"1.0"}}});
}

TEST_CASE("fields of a join out of range are refused") {
  const std::string base = R"("protocol":1,"name":"a",)";
  check({{join(R"("protocol":1,"name":"")"), code::kBadField, {"join.name", "1 to 24"}},
         {join(R"("protocol":1,"name":" \u200b\u0007 ")"), code::kBadField, {"join.name"}},
         {join(R"("protocol":1,"name":7)"), code::kBadField, {"join.name is 7"}},
         {join(base + R"("role":"king")"), code::kBadField, {"join.role", "king", "spectator"}},
         {join(base + R"("room":1)"), code::kBadField, {"join.room"}},
         {join(base + "\"room\":\"" + std::string(kMaxRoomBytes + 1, 'r') + '"'),
          code::kBadField,
          {"join.room", "80"}},
         {join(base + R"("fields":["x","q"])"), code::kBadField, {"join.fields[1]", "\"q\"", "heading_x"}},
         {join(base + R"("fields":["x","x"])"), code::kBadField, {"join.fields[1]", "once"}},
         {join(base + R"("fields":[1])"), code::kBadField, {"join.fields[0]"}},
         {join(base + R"("fields":"some")"), code::kBadField, {"\"all\""}},
         {join(base + R"("format":"binary")"), code::kBadField, {"join.format", "exact"}},
         {join(base + R"("state_hz":0)"), code::kBadField, {"join.state_hz", "1 to 1000"}},
         {join(base + R"("state_hz":1001)"), code::kBadField, {}},
         {join(base + R"("state_hz":20.0)"), code::kBadField, {"20.0"}},
         {join(base + R"("state_hz":null)"), code::kBadField, {"null"}},
         {join(base + R"("stream":"lines")"), code::kBadField, {"join.stream", "\"inputs\""}},
         {join(base + R"("stream":null)"), code::kBadField, {"null"}},
         {join(base + R"("stream":"inputs")"), code::kBadField, {"join.stream", "spectator"}},
         {join(base + R"("role":"bot","stream":"inputs")"), code::kBadField, {"spectator"}}});
}

TEST_CASE("fields of an input out of range are refused, a fraction where an integer is meant too") {
  check({{input(R"("seq":-1,"thrust":0)"), code::kBadField, {"input.seq is -1"}},
         {input(R"("seq":4294967296,"thrust":0)"), code::kBadField, {"4294967295"}},
         {input(R"("seq":1.0,"thrust":0)"), code::kBadField, {"1.0", "integer"}},
         {input(R"("seq":1e3,"thrust":0)"), code::kBadField, {"integer"}},
         {input(R"("seq":"1","thrust":0)"), code::kBadField, {"\"1\""}},
         {input(R"("seq":18446744073709551616,"thrust":0)"), code::kBadField, {"input.seq"}},
         {input(R"("seq":1,"thrust":"fast")"), code::kBadField, {"input.thrust is \"fast\"", "-1 to 1"}},
         {input(R"("seq":1,"thrust":[1])"), code::kBadField, {"an array of 1"}},
         {input(R"("seq":1,"thrust":[1,2,3])"), code::kBadField, {"an array of 3"}},
         {input(R"("seq":1,"thrust":[1,"0"])"), code::kBadField, {"input.thrust[1]", "\"0\""}},
         {input(R"("seq":1,"thrust":{})"), code::kBadField, {"an object"}},
         {input(R"("seq":1,"thrust":null)"), code::kBadField, {"null"}},
         {input(R"("seq":1,"thrust":0,"ticks":0)"), code::kBadField, {"input.ticks", "1 to 4294967294"}},
         {input(R"("seq":1,"thrust":0,"ticks":4294967295)"), code::kBadField, {}},
         {input(R"("seq":1,"thrust":0,"tick":-5)"), code::kBadField, {"input.tick"}},
         {input(R"("seq":1,"thrust":0,"tick":9007199254740993)"), code::kBadField, {}},
         {R"({"type":"ping","t":0.5})", code::kBadField, {"ping.t is 0.5"}},
         {R"({"type":"ping","t":-9007199254740993})", code::kBadField, {"-9007199254740992"}},
         {R"({"type":"chat","text":"\u0001"})", code::kBadField, {"chat.text"}}});
}

TEST_CASE("an error's text is short and clean whatever the line held") {
  const std::string ugly = R"({"type":"\u001b[2J\u202e)" + std::string(3000, 'x') + "\"}";
  const auto message = decode_client(ugly);
  REQUIRE_FALSE(message);
  CHECK(message.error().text.size() < 300);
  CHECK(message.error().text.find('\x1b') == std::string::npos);
  CHECK(message.error().text.find("\u202e") == std::string::npos);
}
