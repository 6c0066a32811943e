#include "shared/protocol/input_line.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "shared/protocol/codec.h"

using namespace woodlouse::protocol;

namespace {

/// The same line for the document's parser: no scanner takes a tab.
std::string for_document(const std::string& line) { return "\t" + line; }

bool has_same_signs(const Input& a, const Input& b) {
  const auto& x = a.thrust.value;
  const auto& y = b.thrust.value;
  return std::signbit(x.x) == std::signbit(y.x) && std::signbit(x.y) == std::signbit(y.y);
}

/// What the scanner takes, the document's parser takes as the same.
bool agree(const std::string& line) {
  const auto scanned = scan_input(line);
  if (!scanned) return true;
  const auto message = decode_client(for_document(line));
  const Input* input = message ? std::get_if<Input>(&*message) : nullptr;
  return input != nullptr && *input == *scanned && has_same_signs(*input, *scanned);
}

const std::vector<std::string> kUsual = {
    R"({"type":"input","seq":12,"thrust":[0.5,-0.25],"ticks":30,"tick":4000})",
    R"({"type":"input","seq":4294967295,"thrust":-0.75})",
    R"({"type": "input", "seq": 1, "thrust": [1, 0], "ticks": 1})",
    R"({"seq":0,"thrust":-0,"tick":999999999999999,"type":"input"})",
    R"({"type":"input","seq":3,"thrust":[-0,-0.0],"ticks":4294967294})",
    R"( { "type" : "input" , "thrust" : 7 , "seq" : 9 } )",
    R"({"type":"input","seq":3,"thrust":[3.25,4]})",
    R"({"type":"input","seq":3,"thrust":0.12345678901234567890123456789})",
};

}  // namespace

TEST_CASE("inputs as programs write them are scanned, and mean what the document's parser says") {
  for (const std::string& line : kUsual) {
    INFO(line);
    CHECK(scan_input(line));
    CHECK(scan_input(line + "\n"));
    CHECK(agree(line));
    CHECK(*decode_client(line) == *decode_client(for_document(line)));
  }
}

TEST_CASE("what is unusual in an input is left to the document's parser") {
  for (const std::string line : {
           R"({"type":"input","seq":1,"thrust":[1,0],"note":1})",
           R"({"type":"input","seq":1,"seq":1,"thrust":[1,0]})",
           R"({"type":"input","seq":1,"thrust":[1,0],"thrust":[1,0]})",
           R"({"type":"input","type":"input","seq":1,"thrust":[1,0]})",
           R"({"type":"input","seq":1,"thrust":1e-1})",
           R"({"type":"input","seq":1,"thrust":.5})",
           R"({"type":"input","seq":1,"thrust":5.})",
           R"({"type":"input","seq":1,"thrust":+1})",
           R"({"type":"input","seq":1,"thrust":01})",
           R"({"type":"input","seq":1,"thrust":-})",
           R"({"type":"input","seq":1,"thrust":inf})",
           R"({"type":"input","seq":1,"thrust":0x1})",
           R"({"type":"input","seq":1,"thrust":null})",
           R"({"type":"input","seq":1,"thrust":[1]})",
           R"({"type":"input","seq":1,"thrust":[1,0,0]})",
           R"({"type":"input","seq":1,"thrust":[1,0})",
           R"({"type":"input","seq":1.0,"thrust":1})",
           R"({"type":"input","seq":-1,"thrust":1})",
           R"({"type":"input","seq":00,"thrust":1})",
           R"({"type":"input","seq":4294967296,"thrust":1})",
           R"({"type":"input","seq":99999999999999999999,"thrust":1})",
           R"({"type":"input","seq":1,"thrust":1,"ticks":0})",
           R"({"type":"input","seq":1,"thrust":1,"ticks":null})",
           R"({"type":"input","seq":1,"thrust":1,"tick":9007199254740992})",
           R"({"type":"input","thrust":1})",
           R"({"type":"input","seq":1})",
           R"({"seq":1,"thrust":1})",
           R"({"type":"inpu\u0074","seq":1,"thrust":1})",
           R"({"type":"ping","seq":1,"thrust":1})",
           R"({"type":"input","seq":1,"thrust":1,})",
           R"({"type":"input","seq":1,"thrust":1}})",
           R"({"type":"input","seq":1,"thrust":1} x)",
           R"({"type":"input","seq":1,"thrust":1)",
           R"([{"type":"input","seq":1,"thrust":1}])",
           R"({})",
           R"()",
       }) {
    INFO(line);
    CHECK_FALSE(scan_input(line));
  }
  std::string number = R"({"type":"input","seq":1,"thrust":0.)" + std::string(400, '0') + "1}";
  CHECK_FALSE(scan_input(number));  // too small for a double
  number = R"({"type":"input","seq":1,"thrust":)" + std::string(400, '9') + "}";
  CHECK_FALSE(scan_input(number));
}

TEST_CASE(
    "of a hundred thousand mutated inputs none is taken otherwise than the document's parser takes it") {
  std::mt19937_64 random(12);
  const std::string pieces = "0123456789-+.eE,:[]{}\" \t\nabtypesqkhru\\\0\xff";
  std::size_t taken = 0;
  for (int round = 0; round < 100'000; ++round) {
    std::string line = kUsual[random() % kUsual.size()];
    for (std::uint64_t n = 1 + random() % 3; n > 0 && !line.empty(); --n) {
      const std::size_t at = random() % line.size();
      const char piece = pieces[random() % pieces.size()];
      switch (random() % 4) {
        case 0:
          line[at] = piece;
          break;
        case 1:
          line.insert(at, 1, piece);
          break;
        case 2:
          line.erase(at, 1);
          break;
        default:
          line.insert(at, line.substr(random() % line.size(), random() % 20));
      }
    }
    taken += scan_input(line) ? 1 : 0;
    if (!agree(line)) FAIL(line);
  }
  CHECK(taken > 3'000);
}
