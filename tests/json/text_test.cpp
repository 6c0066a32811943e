#include "shared/json/text.h"

#include <bit>
#include <catch2/catch.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>

#include "shared/json/decimal.h"
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
  char room[kNumberRoom];
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

TEST_CASE("every double is written as the standard library writes it") {
  std::mt19937_64 random(11);
  char room[kNumberRoom];
  char expected[kNumberRoom];
  std::uint64_t own = 0;  // not left to the standard library
  const auto check = [&](double value) {
    if (!std::isfinite(value) || (value == 0.0 && std::signbit(value))) return;
    own += has_decimal(value) ? 1 : 0;
    const std::string_view text(room, static_cast<std::size_t>(write_double(room, value) - room));
    const auto end = std::to_chars(expected, expected + kNumberRoom, value).ptr;
    const std::string_view wanted(expected, static_cast<std::size_t>(end - expected));
    if (text != wanted) FAIL(text << " instead of " << wanted);
  };
  const auto check_bits = [&](std::uint64_t bits) { check(std::bit_cast<double>(bits)); };

  // Every exponent, both signs: at a power of two and around it, where the doubles' spacing changes; random
  // mantissas, and those of few bits, as many of which end in a tie as there are.
  for (std::uint64_t exponent = 0; exponent < 0x800; ++exponent) {
    for (const std::uint64_t sign : {std::uint64_t{0}, std::uint64_t{1} << 63}) {
      const std::uint64_t power = sign | exponent << 52;
      for (std::uint64_t step = 0; step < 20; ++step) {
        check_bits(power + step);
        if (exponent != 0) check_bits(power - step);
      }
      for (int round = 0; round < 100; ++round) {
        const std::uint64_t mantissa = random() >> 12;
        check_bits(power | mantissa);
        check_bits(power | (mantissa >> (random() % 52) << (random() % 52) & 0xf'ffff'ffff'ffff));
      }
    }
  }
  // What is written by the own way, with mantissas of any length.
  for (std::uint64_t exponent = 1023 - 8; exponent < 1023 + 52; ++exponent)
    for (int round = 0; round < 5000; ++round)
      check_bits(exponent << 52 | ((random() >> 12) & ~((std::uint64_t{1} << (random() % 53)) - 1)));
  // Multiples of the powers of two and of ten that a game's numbers are.
  for (int shift = 1; shift <= 60; ++shift)
    for (int round = 0; round < 5000; ++round)
      check(std::ldexp(static_cast<double>(random() >> (random() % 60)), -shift));
  double power_of_ten = 1e-300;
  for (int exponent = -300; exponent < 300; ++exponent, power_of_ten *= 10)
    for (int round = 0; round < 500; ++round)
      check(static_cast<double>(random() >> (random() % 63)) * power_of_ten);
  for (double divisor = 10.0; divisor < 1e17; divisor *= 10)
    for (int round = 0; round < 10'000; ++round)
      check(static_cast<double>(random() % 1'000'000'000) / divisor);
  for (int whole = 0; whole < 200'000; ++whole) check(whole);
  CHECK(own > 400'000);
}

TEST_CASE("the doubles a game is full of are written in short") {
  char room[kNumberRoom];
  const auto written = [&room](double value) { return std::string(room, write_double(room, value)); };
  CHECK(written(0.0) == "0");
  CHECK(written(-0.0) == "-0.0");
  CHECK(written(-1.0) == "-1");
  CHECK(written(0.5) == "0.5");
  CHECK(written(-0.25) == "-0.25");
  CHECK(written(0.00390625) == "0.00390625");
  CHECK(written(0.00390624) == "0.00390624");
  CHECK(written(123.45678901234567) == "123.45678901234567");
  CHECK(written(-4503599627370495.5) == "-4503599627370495.5");
  CHECK(written(0.50000762939453125) == "0.5000076293945312");  // a tie: the even one
  CHECK(written(100000.0) == "1e+05");
}

TEST_CASE("no double is longer than the room it is promised") {
  char room[kNumberRoom];
  for (const double value :
       {-2.2250738585072014e-308, -1.7976931348623157e308, -5e-324, -0.0, -0.0039062500000000009}) {
    CHECK(std::string(room, write_double(room, value)) == double_text(value));
  }
}

}  // namespace woodlouse::json
