#include "server/log.h"

#include <catch2/catch.hpp>

using woodlouse::server::json_escaped;

TEST_CASE("a logged text cannot leave its JSON string") {
  CHECK(json_escaped("plain, wörds 😀") == "plain, wörds 😀");
  CHECK(json_escaped("say \"hi\" \\ bye") == R"(say \"hi\" \\ bye)");
  CHECK(json_escaped("a\nb\x1b[2J") == R"(a\u000ab\u001b[2J)");
}

TEST_CASE("bytes that are no UTF-8 are logged as question marks") {
  CHECK(json_escaped("\xff\xfe") == "??");
  CHECK(json_escaped("a\xc3") == "a?");
  CHECK(json_escaped("\xc0\xaf") == "??");       // overlong
  CHECK(json_escaped("\xed\xa0\x80") == "???");  // a surrogate
  CHECK(json_escaped("\xe2\x82 x") == "?? x");
}
