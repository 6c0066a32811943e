#include "shared/protocol/text_cleaning.h"

#include <catch2/catch.hpp>
#include <random>
#include <string>

#include "shared/core/utf8.h"

using woodlouse::protocol::clean_text;

TEST_CASE("plain text of any script passes as it is") {
  for (const std::string text : {"ann", "Zoë", "Олег", "木虱", "🐞 bug", "שלום", "a-b_c (1)"}) {
    CHECK(clean_text(text, 100) == text);
  }
}

TEST_CASE("control characters and escape sequences lose what makes them act") {
  CHECK(clean_text("\x1b[31mred\x1b[0m", 100) == "[31mred[0m");
  CHECK(clean_text(std::string("a\0b\x07\x7f", 5), 100) == "ab");
  CHECK(clean_text("a\xc2\x9b"
                   "31mb",
                   100) == "a31mb");  // C1: CSI
}

TEST_CASE("characters without width or that turn the writing are removed") {
  CHECK(clean_text("a\u200b\u200d\u2060\ufeff\u00adb", 100) == "ab");
  CHECK(clean_text("\u202eadmin\u202c \u2066x\u2069", 100) == "admin x");
  CHECK(clean_text("\u200f\u061cx\ufe0f", 100) == "x");
}

TEST_CASE("blanks collapse and are trimmed") {
  CHECK(clean_text("  a \t\r\n\u00a0\u3000 b  ", 100) == "a b");
  CHECK(clean_text(" \t\u2003\u3164\u200b ", 100).empty());
  CHECK(clean_text("", 100).empty());
}

TEST_CASE("a cut falls between characters") {
  CHECK(clean_text("abcdef", 4) == "abcd");
  CHECK(clean_text("abc\u20acd", 5) == "abc");
  CHECK(clean_text("abc\u20acd", 6) == "abc\u20ac");
  CHECK(clean_text("abc   def", 4) == "abc");
  CHECK(clean_text("\U0001f41e", 3).empty());
}

TEST_CASE(
    "of random bytes what remains is clean UTF-8 within the limit, and cleaning it again changes nothing") {
  std::mt19937_64 random(7);
  for (int round = 0; round < 10000; ++round) {
    std::string bytes(random() % 40, '\0');
    for (char& c : bytes) c = static_cast<char>(random() % 256);
    const std::size_t limit = random() % 30;
    const std::string once = clean_text(bytes, limit);
    REQUIRE(once.size() <= limit);
    REQUIRE(clean_text(once, limit) == once);
    std::string_view rest = once;
    while (!rest.empty()) {
      const auto character = woodlouse::core::first_character(rest);
      REQUIRE(character.valid);
      REQUIRE(character.code >= 0x20);
      REQUIRE_FALSE((character.code >= 0x7f && character.code <= 0x9f));
      rest.remove_prefix(character.size);
    }
  }
}

TEST_CASE("of marks over one character two stay, and writing that needs them is left alone") {
  std::string zalgo = "a";
  for (int k = 0; k < 10; ++k) zalgo += "\u0301\u0489";
  CHECK(clean_text(zalgo + "b\u0308", 100) == "a\u0301\u0489b\u0308");
  CHECK(clean_text("\u0e01\u0e34\u0e49", 100) == "\u0e01\u0e34\u0e49");
  CHECK(clean_text(clean_text(zalgo, 100), 100) == clean_text(zalgo, 100));
}
