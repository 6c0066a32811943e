#include "shared/json/text.h"

#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <string>

#include "shared/json/document.h"

namespace woodlouse::json {
namespace {

std::string written(std::string_view text) {
  std::string out;
  append_string(out, text);
  return out;
}

}  // namespace

TEST_CASE("strings are escaped where they must be and plain elsewhere") {
  CHECK(written("") == R"("")");
  CHECK(written("Zoë 木虱 🐞 /") == R"("Zoë 木虱 🐞 /")");
  CHECK(written("a\"b\\c\nd\te\rf") == R"("a\"b\\c\nd\te\rf")");
  CHECK(written(std::string("\0\x1b\x7f", 3)) == R"("\u0000\u001b\u007f")");
}

TEST_CASE("bytes that are no UTF-8 become U+FFFD") {
  CHECK(written("a\xff"
                "b") ==
        "\"a\ufffd"
        "b\"");
  CHECK(written("\xc3") == "\"\ufffd\"");
  CHECK(written("\xed\xa0\x80") == "\"\ufffd\ufffd\ufffd\"");
}

TEST_CASE("any bytes written as a string are read back, those of UTF-8 unchanged") {
  std::mt19937_64 random(3);
  for (int round = 0; round < 20000; ++round) {
    std::string bytes(random() % 20, '\0');
    for (char& c : bytes) c = static_cast<char>(random() % (round % 2 == 0 ? 0x80 : 0x100));
    const std::string text = written(bytes);
    const auto document = parse(text, {});
    REQUIRE(document);
    if (round % 2 == 0) REQUIRE(document->root().text() == bytes);
  }
}

TEST_CASE("JSON for a terminal is the same JSON, with escapes for what is not printable") {
  const std::string json = written("a\x7f\xc2\x9b\xe2\x80\xae\xf3\xa0\x81\xa1 w\xc3\xb6rd\n") + "\n";
  const std::string shown = printable_json(json);
  CHECK(shown == "\"a\\u007f\\u009b\\u202e\\udb40\\udc61 w\xc3\xb6rd\\n\"\n");
  const auto before = parse(json, {});
  const auto after = parse(shown, {});
  REQUIRE((before && after));
  CHECK(before->root().text() == after->root().text());
}

TEST_CASE("foreign text is cited cut and printable") {
  CHECK(shown("a\x1b\xc2\x9b\xe2\x80\xae\xff z") == "a???? z");
  CHECK(shown("abcdef", 4) == "abcd...");
}

TEST_CASE("integers are written whole, to the ends of 64 bits") {
  std::string out;
  append_integer(out, std::numeric_limits<std::int64_t>::min());
  append_integer(out += ' ', std::numeric_limits<std::uint64_t>::max());
  append_integer(out += ' ', std::uint8_t{7});
  CHECK(out == "-9223372036854775808 18446744073709551615 7");
}

TEST_CASE("integers written digit by digit in parallel are those of the standard library") {
  std::mt19937_64 random(9);
  char room[kMaxNumberChars];
  const auto check = [&room](long long value) {
    REQUIRE(std::string(room, write_integer(room, value)) == std::to_string(value));
  };
  for (const auto value : {std::numeric_limits<long long>::min(), std::numeric_limits<long long>::max(), 0LL})
    check(value);
  for (long long power = 1; power <= 1'000'000'000'000; power *= 10) {
    for (const long long value : {power - 1, power, power + 1}) {
      check(value);
      check(-value);
    }
  }
  for (long long value = 0; value < 20'000; ++value) check(value);
  for (int round = 0; round < 200'000; ++round) {
    const auto value = static_cast<long long>(random() >> (random() % 64));
    check(value);
    check(-value);
  }
}

TEST_CASE("no double is longer than the room it is promised") {
  char room[kMaxNumberChars];
  for (const double value : {-2.2250738585072014e-308, -1.7976931348623157e308, -5e-324, -0.0}) {
    CHECK(std::string(room, write_double(room, value)) == double_text(value));
  }
}

}  // namespace woodlouse::json
