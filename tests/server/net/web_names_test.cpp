#include "server/net/web_names.h"

#include <catch2/catch.hpp>

#include <string>
#include <tuple>

namespace woodlouse::server::web_names_test {

namespace {

const WebNames kNames{{"lice.example.org"}, {Origin{true, "games.example.org", 443}}};

}  // namespace

TEST_CASE("a host's name is read with its port, in lower case") {
  CHECK(parse_authority("Example.ORG") == Authority{"example.org", {}});
  CHECK(parse_authority("example.org:80") == Authority{"example.org", 80});
  CHECK(parse_authority("10.0.0.1:65535") == Authority{"10.0.0.1", 65535});
  CHECK(parse_authority("[::1]") == Authority{"::1", {}});
  CHECK(parse_authority("[2001:DB8::1]:7778") == Authority{"2001:db8::1", 7778});
  const std::string none = GENERATE(as<std::string>{}, "", ":80", "a:", "a:65536", "a:-1", "a:8x", "a b",
                                    "a/b", "user@a", "[::1", "[::1]7", "::1", "[a]", "[127.0.0.1]", "a,b",
                                    "<a>", std::string("a\0", 2), std::string(254, 'a'));
  INFO(none);
  CHECK_FALSE(parse_authority(none));
}

TEST_CASE("a page's origin is scheme, host and port, and no more") {
  CHECK(parse_origin("http://a") == Origin{false, "a", 80});
  CHECK(parse_origin("HTTPS://A.b") == Origin{true, "a.b", 443});
  CHECK(parse_origin("https://a:80") == Origin{true, "a", 80});
  CHECK(parse_origin("http://[::1]:7778") == Origin{false, "::1", 7778});
  const std::string none =
      GENERATE("", "null", "a", "//a", "ftp://a", "file://", "http://", "http://a/", "http://a:0x1",
               "http://u@a", "http://a b", "http://a http://b", "moz-extension://a");
  INFO(none);
  CHECK_FALSE(parse_origin(none));
}

TEST_CASE("only addresses, localhost and names that were given are this server's") {
  const std::string own = GENERATE("127.0.0.1", "127.0.0.1:7778", "[::1]:7778", "localhost", "LOCALHOST:1",
                                   "10.1.2.3", "lice.example.org", "Lice.Example.Org:7778");
  CHECK(why_not_host(own, kNames).empty());
  const std::string other =
      GENERATE("", "evil.example.org", "lice.example.org.evil.org", "localhost.evil.org",
               "127.0.0.1.evil.org", "example.org", "1.2.3.4.5", "http://localhost");
  const std::string why = why_not_host(other, kNames);
  INFO(other);
  CHECK_FALSE(why.empty());
  CHECK((other.empty() || why.find(other) == std::string::npos));
}

TEST_CASE("a page may play where it came from, and elsewhere where that was allowed") {
  const auto [origin, is_secure, host, may] = GENERATE(table<std::string, bool, std::string, bool>({
      {"http://127.0.0.1:7778", false, "127.0.0.1:7778", true},
      {"http://localhost", false, "localhost:80", true},
      {"http://LOCALHOST:80", false, "localhost", true},
      {"https://localhost", true, "localhost", true},
      {"https://localhost", true, "localhost:443", true},
      {"http://[::1]:7778", false, "[::1]:7778", true},
      {"https://games.example.org", false, "127.0.0.1:7778", true},
      {"https://games.example.org:443", true, "127.0.0.1", true},
      {"http://games.example.org", false, "127.0.0.1:7778", false},
      {"https://games.example.org:444", false, "127.0.0.1:7778", false},
      {"https://127.0.0.1:7778", false, "127.0.0.1:7778", false},
      {"http://127.0.0.1:7779", false, "127.0.0.1:7778", false},
      {"http://localhost:7778", false, "127.0.0.1:7778", false},
      {"http://evil.org", false, "127.0.0.1:7778", false},
      {"null", false, "127.0.0.1:7778", false},
      {"", false, "127.0.0.1:7778", false},
  }));
  INFO(origin << " at " << host);
  CHECK(why_not_origin(origin, is_secure, host, kNames).empty() == may);
}

TEST_CASE("names and origins are checked as they are typed") {
  CHECK(checked_web_host("Lice.Example.org").value() == "lice.example.org");
  CHECK(checked_web_origin("https://a:8443").value() == Origin{true, "a", 8443});
  for (const auto* host : {"a:80", "http://a", ""})
    CHECK(checked_web_host(host).error().where.starts_with("--web-host"));
  for (const auto* origin : {"a", "https://a/", "null", ""})
    CHECK(checked_web_origin(origin).error().where.starts_with("--web-origin"));
}

}  // namespace woodlouse::server::web_names_test
