// Lines that no program would send: whatever the bytes, the answer is a message or an error, and what passes
// as a message is in range and passes again.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "shared/protocol/codec.h"

using namespace woodlouse::protocol;

namespace {

const std::vector<std::string> kClientLines = {
    R"({"type":"join","protocol":1,"role":"bot","name":"Zo\u00eb","room":"r","fields":["x","id","yaw"],"format":"exact","state_hz":20})",
    R"({"type":"join","protocol":1,"name":"a","view":{"x":-1.5,"y":2,"radius":8,"rows":30}})",
    R"({"type":"view","louse":7,"radius":1e3})",
    R"({"type":"input","seq":12,"thrust":[0.5,-0.25],"ticks":30,"tick":4000})",
    R"({"type":"input","seq":4294967295,"thrust":-0.75})",
    R"({"type":"chat","text":"h\u00e9llo \"you\" \ud83d\udc1e"})",
    R"({"type":"list"})",
    R"({"type":"ping","t":-9007199254740992,"x":{"y":[[1e-5,2.5E+3],null,true]}})",
};

const std::vector<std::string> kServerLines = {
    R"({"type":"hello","protocol":1,"behavior":1,"server":"w","session":"1","rooms":["a"],"features":[],"limits":{"line":4096,"depth":8,"messages_per_s":60,"burst":120,"outbox_bytes":4194304,"handshake_s":10,"idle_s":60,"per_address":256,"per_room":1024},"hosts":["10.0.0.6:7777","[::1]:7778"]})",
    R"({"type":"welcome","id":1,"resume_token":"","room":"a","tick":5,"tick_hz":60,"state_hz":20,"fields":["id","x"],"quantum":[1,0.0009765625],"format":"quantized","stream":"inputs","map":{"name":"a","hash":"0123456789abcdef","extent":[-1,-1,1,1],"bytes":9},"physics":{"gravity":9.81,"drag":0.2,"friction":0.05,"thrust_max":4,"edge_restitution":0.5},"mode":"roam","players":[{"id":1,"name":"a","role":"bot"}]})",
    R"({"type":"key","tick":60,"louse":[[1,512,-3,0,7],[2,0,0,0,0]],"hash":"00000000000000ff"})",
    R"({"type":"delta","tick":63,"base":60,"louse":[[1,512,-3,0,7]],"gone":[2]})",
    R"({"type":"ack","seq":1,"tick":63,"margin_us":-5,"late":false,"dropped":false,"clamped":true,"you":{"tick":64,"id":1,"x":1.5,"y":-0.0,"vx":0,"vy":1e-9,"heading":[1,0],"thrust":[0.5,0],"thrust_kind":1,"thrust_ticks":4294967295,"phase":0,"flight_z":0,"flight_vz":0,"distance":3.25}})",
    R"({"type":"map","name":"m","hash":"0123456789abcdef","definition":{"terrain":{"heights":[[1,2],[3,4]]}},"knots":{}})",
    R"({"type":"event","n":3,"tick":9,"kind":"chat","id":1,"name":"a","text":"b"})",
    R"({"type":"rooms","rooms":[{"name":"a","map":"m","players":1,"bots":2,"spectators":3}]})",
    R"({"type":"error","code":"rate_limited","text":"t","fatal":false,"retry_after_ms":5})",
    R"({"type":"bye","code":"moved","text":"t","resumable":true,"address":"10.0.0.6:7777"})",
};

std::string mutated(const std::vector<std::string>& lines, std::mt19937_64& random) {
  static const std::vector<std::string> kPieces = {"0",
                                                   "-1",
                                                   "1.0",
                                                   "1e999",
                                                   "-0",
                                                   "null",
                                                   "true",
                                                   "NaN",
                                                   "{",
                                                   "}",
                                                   "[",
                                                   "]",
                                                   ",",
                                                   ":",
                                                   "\"",
                                                   "\\",
                                                   "\\u0000",
                                                   "\\ud800",
                                                   "\xff",
                                                   "\xc2",
                                                   std::string(1, '\0'),
                                                   "\"type\":\"list\",",
                                                   "9007199254740993",
                                                   "4294967296",
                                                   "18446744073709551616",
                                                   "[[[[[[[[[",
                                                   "\"\"",
                                                   "{}",
                                                   "\n"};
  std::string line = lines[random() % lines.size()];
  const std::size_t edits = 1 + random() % 4;
  for (std::size_t edit = 0; edit < edits && !line.empty(); ++edit) {
    const std::size_t at = random() % line.size();
    const std::string& other = lines[random() % lines.size()];
    switch (random() % 6) {
      case 0:
        line[at] = static_cast<char>(random() % 256);
        break;
      case 1:
        line.erase(at, 1 + random() % 8);
        break;
      case 2:
        line.insert(at, kPieces[random() % kPieces.size()]);
        break;
      case 3:
        line.resize(at);
        break;
      case 4:
        line.insert(at, other.substr(random() % other.size(), random() % 40));
        break;
      default:
        line.replace(at, 1 + random() % 3, kPieces[random() % kPieces.size()]);
        break;
    }
  }
  return line;
}

void check(const DecodeError& error) {
  REQUIRE_FALSE(error.code.empty());
  REQUIRE_FALSE(error.text.empty());
  REQUIRE(error.text.size() < 1000);
  // What is told about a line must itself be a line.
  const ServerMessage told = ErrorMessage{error.code, error.text, false, std::nullopt};
  const auto back = decode_server(encode(told), default_columns(), Format::kQuantized);
  REQUIRE(back);
  REQUIRE(*back == told);
}

void check(const ClientMessage& message) {
  if (const auto* input = std::get_if<Input>(&message)) {
    REQUIRE(woodlouse::core::dot(input->thrust.value, input->thrust.value) <= 1.0);
    if (input->ticks) REQUIRE(*input->ticks >= 1);
  }
  if (const auto* join = std::get_if<Join>(&message)) {
    REQUIRE_FALSE(join->name.empty());
    REQUIRE(join->name.size() <= kMaxNameBytes);
    REQUIRE(join->fields.at(0) == Column::kId);
  }
  auto again = decode_client(encode(message));
  REQUIRE(again);
  if (auto* input = std::get_if<Input>(&*again)) input->clamped = std::get<Input>(message).clamped;
  REQUIRE(*again == message);
}

}  // namespace

TEST_CASE("the lines that are mutated are good ones") {
  for (const auto& line : kClientLines) CHECK(decode_client(line));
  for (const auto& line : kServerLines) CHECK(decode_server(line, default_columns(), Format::kQuantized));
}

TEST_CASE("a mutated client line is a message in range or an error") {
  std::mt19937_64 random(20260101);
  int passed = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::string line = mutated(kClientLines, random);
    CAPTURE(line);
    const auto message = decode_client(line);
    passed += message ? 1 : 0;
    if (message) check(*message);
    if (!message) check(message.error());
  }
  CHECK(passed > 200);
}

TEST_CASE("a mutated server line is a message or an error") {
  std::mt19937_64 random(20260102);
  int passed = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::string line = mutated(kServerLines, random);
    CAPTURE(line);
    const auto message =
        decode_server(line, default_columns(), round % 2 == 0 ? Format::kQuantized : Format::kExact);
    if (!message) {
      check(message.error());
      continue;
    }
    ++passed;
    if (const auto* frame = std::get_if<Frame>(&*message)) {
      REQUIRE(frame->values.size() == frame->rows() * 5);
      for (const double value : frame->values) REQUIRE(std::isfinite(value));
    }
  }
  CHECK(passed > 200);
}

TEST_CASE("lines of random bytes and of random JSON characters are refused, never worse") {
  std::mt19937_64 random(9);
  constexpr std::string_view kAlphabet = "{}[]\",:\\ \t0123456789eE+-.truefalsn\xc3\xa9";
  for (int round = 0; round < 20000; ++round) {
    std::string line(random() % 64, '\0');
    for (char& c : line) {
      c = round % 2 == 0 ? static_cast<char>(random() % 256) : kAlphabet[random() % kAlphabet.size()];
    }
    CAPTURE(line);
    const auto message = decode_client(line);
    REQUIRE_FALSE(message);
    check(message.error());
  }
}
