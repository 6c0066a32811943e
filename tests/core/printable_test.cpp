#include "shared/core/printable.h"

#include <catch2/catch.hpp>

#include "shared/core/error.h"

using namespace woodlouse::core;

TEST_CASE("what is printable stays as it is, in any script") {
  for (const char* text :
       {"", "plain", "wörds, 水, \xf0\x9f\x98\x80", "\"quotes\" and \\", "\xc2\xa0\xef\xbf\xbd"})
    CHECK(printable(text) == text);
}

TEST_CASE("what a terminal or a reader could be fooled by becomes a question mark") {
  const struct {
    std::string text;
    const char* shown;
  } cases[] = {
      {"a\nb\rc\td", "a?b?c?d"},
      {std::string("a\0b", 3), "a?b"},
      {"\x1b[2J\x07\x7f", "?[2J??"},
      {"\xc2\x80\xc2\x85\xc2\x9b\xc2\x9f", "????"},                  // C1: a lone CSI is one of them
      {"\xe2\x80\xae\xe2\x80\xaa\xe2\x81\xa6\xe2\x81\xa9", "????"},  // overrides and isolates
      {"\xe2\x80\x8e\xe2\x80\x8f\xd8\x9c", "???"},                   // marks
      {"\xe2\x80\xa8\xe2\x80\xa9", "??"},                            // separators
      {"\xef\xbb\xbf\xe2\x80\x8b\xc2\xad", "???"},                   // without a shape
      {"\xf3\xa0\x81\xa1", "?"},                                     // a tag
      {"\xff\xc3", "??"},
      {"\xed\xa0\x80", "???"},  // a surrogate
  };
  for (const auto& [text, shown] : cases) {
    CHECK(printable(text) == shown);
    CHECK(printable(printable(text)) == shown);
  }
}

TEST_CASE("whatever an error is made of, it is one printable line") {
  const std::string evil = "x\x1b]0;\n\xe2\x80\xae\xc2\x9b";
  const std::string seen = "x?]0;???";
  CHECK(Error(evil, evil, evil).text() == seen + ": " + seen + " (" + seen + ")");
  CHECK(fail(evil, evil).value().where == seen);
  CHECK(Error({}, "what").text() == "what");
}
