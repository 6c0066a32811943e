#include "server/net/listen_address.h"

#include <catch2/catch.hpp>

using namespace woodlouse::server;

TEST_CASE("a listen address is read as people write it, and comes back so") {
  const auto [text, host, port] = GENERATE(table<std::string, std::string, int>({
      {"127.0.0.1:7777", "127.0.0.1", 7777},
      {"localhost:0", "localhost", 0},
      {"10.0.0.1", "10.0.0.1", 7777},
      {":65535", "0.0.0.0", 65535},
      {"[::1]:80", "::1", 80},
      {"[::]", "::", 7777},
  }));
  const auto address = parse_listen_address(text);
  REQUIRE(address);
  CHECK(address->host == host);
  CHECK(address->port == port);
  CHECK(parse_listen_address(to_text(*address)).value() == *address);
}

TEST_CASE("a listen address that is none is refused with what to write instead") {
  const std::string text = GENERATE("127.0.0.1:", "127.0.0.1:65536", "host:-1", "host:7777x", "::1:7777",
                                    "[::1", "[::1]7777", "host:0x10");
  const auto address = parse_listen_address(text);
  REQUIRE_FALSE(address);
  CHECK_THAT(address.error().where, Catch::Contains(text));
  CHECK_FALSE(address.error().hint.empty());
}

TEST_CASE("an address says by which option it was given, and has the port of that") {
  CHECK(parse_listen_address("[::1]", "--web", kDefaultWebPort).value() == ListenAddress{"::1", 7778});
  const auto address = parse_listen_address("host:x", "--web", kDefaultWebPort);
  REQUIRE_FALSE(address);
  CHECK(address.error().where == "--web host:x");
}

TEST_CASE("what listens at every address is opened at this machine's own") {
  const auto [text, opened] = GENERATE(table<std::string, std::string>({
      {"0.0.0.0", "127.0.0.1:7778"},
      {"::", "[::1]:7778"},
      {"192.0.2.1", "192.0.2.1:7778"},
  }));
  CHECK(to_text(reachable({boost::asio::ip::make_address(text), 7778})) == opened);
}
