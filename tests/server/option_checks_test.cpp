#include "server/option_checks.h"

#include <string>

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;
using std::chrono::seconds;

TEST_CASE("times have digits and a unit") {
  const auto [text, wanted] = GENERATE(table<std::string, int>(
      {{"10s", 10}, {"90m", 5400}, {"1h", 3600}, {"2d", 172'800}, {"10000d", 864'000'000}}));
  CHECK(parse_duration("--every", text, seconds(10)) == seconds(wanted));
}

TEST_CASE("what is no time, too short or too long is refused with what to write") {
  for (const char* const text : {"", "10", "s", "1.5h", "-1h", "+1h", " 1h", "1h ", "1w", "1H", "10001d",
                                 "18446744073709551615d", "99999999999999999999s"}) {
    const auto refused = parse_duration("--every", text, seconds(10));
    INFO(text);
    REQUIRE_FALSE(refused);
    CHECK_THAT(refused.error().text(), Catch::StartsWith("--every " + std::string(text) + ": is no time") &&
                                           Catch::Contains("--every 1h"));
  }
  const auto refused = parse_duration("--every", "9s", seconds(10));
  REQUIRE_FALSE(refused);
  CHECK(refused.error().text() == "--every 9s: is too short (at least 10s)");
}

TEST_CASE("sizes are bytes, or have a unit of a power of 1024") {
  const auto [text, wanted] = GENERATE(table<std::string, std::uint64_t>(
      {{"1", 1}, {"3K", 3072}, {"5M", 5u << 20}, {"10G", 10ull << 30}, {"2T", 2ull << 40}}));
  CHECK(parse_bytes("--keep", text) == wanted);
}

TEST_CASE("what is no size is refused with what to write") {
  for (const char* const text :
       {"", "0", "0G", "K", "1k", "1KB", "1.5G", "-1", "1 G", "16777216T", "18446744073709551616"}) {
    const auto refused = parse_bytes("--keep", text);
    INFO(text);
    REQUIRE_FALSE(refused);
    CHECK_THAT(refused.error().text(), Catch::StartsWith("--keep " + std::string(text) + ": is no size") &&
                                           Catch::Contains("--keep 10G"));
  }
}
