// What is taken for the address of a server, and which of several is tried next.
#include "shared/protocol/whereabouts.h"

#include <catch2/catch.hpp>
#include <string>

#include "shared/protocol/codec.h"

using namespace woodlouse::protocol;
using Sent = Whereabouts::Sent;

namespace {

const HostAddress kFirst{"first.example", 7777};
const HostAddress kSecond{"10.0.0.6", 7777};
const HostAddress kThird{"2001:db8::7", 7778};

}  // namespace

TEST_CASE("an address of the wire is a host and a port") {
  CHECK(parse_host_address("first.example:7777") == kFirst);
  CHECK(parse_host_address("10.0.0.6:7777") == kSecond);
  CHECK(parse_host_address("[2001:db8::7]:7778") == kThird);
  for (const HostAddress& address : {kFirst, kSecond, kThird})
    CHECK(parse_host_address(address.text()) == address);
  CHECK(parse_host_address("[::]:1") == HostAddress{"::", 1});
  CHECK(parse_host_address("[::ffff:10.0.0.6]:65535") == HostAddress{"::ffff:10.0.0.6", 65535});
  CHECK(parse_host_address("[1:2:3:4:5:6:7:8]:9") == HostAddress{"1:2:3:4:5:6:7:8", 9});
  CHECK(parse_host_address("localhost:7777") == HostAddress{"localhost", 7777});
}

TEST_CASE("what is no host and port is no address") {
  for (const char* text : {"",
                           ":",
                           "host",
                           "host:",
                           ":7777",
                           "host:0",
                           "host:65536",
                           "host:07777",
                           "host:+1",
                           "host: 1",
                           "host:7777 ",
                           " host:7777",
                           "host:7777/room",
                           "http://host:7777",
                           "/tmp/socket",
                           "/tmp/socket:1",
                           "unix:/tmp/socket",
                           "file:///etc/passwd:1",
                           "a b:1",
                           "user@host:1",
                           "-h:1",
                           ".host:1",
                           "ho\nst:1",
                           "ho\x1b[2Jst:1",
                           "h\xc3\xb6st:1",
                           "::1:7777",
                           "[::1]",
                           "[::1]:",
                           "[]:1",
                           "[::1:7777",
                           "::1]:7777",
                           "[host]:1",
                           "[1:2]:1",
                           "[1:2:3:4:5:6:7:8:9]:1",
                           "[1::2::3]:1",
                           "[:::]:1",
                           "[12345::]:1",
                           "[::g]:1",
                           "[fe80::1%eth0]:1",
                           "[1:2:3:4:5:6:7::8]:1",
                           "10.0.0:1",
                           "10.0.0.256:1",
                           "10.0.0.06:1",
                           "1.2.3.4.5:1",
                           "7:7777",
                           "[10.0.0.6]:1",
                           "[1:2:3:4:5:6:7:]:1"}) {
    INFO(text);
    CHECK_FALSE(parse_host_address(text));
  }
  CHECK(parse_host_address(std::string(253, 'a') + ":7777"));
  CHECK_FALSE(parse_host_address(std::string(254, 'a') + ":7777"));
}

TEST_CASE("who is sent on goes there, but no more than twice running") {
  Whereabouts places(kFirst);
  CHECK(places.place() == kFirst);
  CHECK_FALSE(places.has_others());
  CHECK(places.moved("10.0.0.6:7777", std::nullopt) == Sent::kFollows);
  CHECK(places.place() == kSecond);
  places.welcomed({});
  CHECK(places.moved("[2001:db8::7]:7778", 0.1) == Sent::kFollows);
  CHECK(places.moved("first.example:7777", 0.1) == Sent::kTooOften);
  CHECK(places.place() == kThird);
  places.lost(0.1, 0.5);
  CHECK(places.place() == kThird);
  CHECK(places.moved("first.example:7777", std::nullopt) == Sent::kFollows);
}

TEST_CASE("who has stayed a while may be sent on as often as before") {
  Whereabouts places(kFirst);
  for (int k = 0; k < 5; ++k) {
    CHECK(places.moved(k % 2 == 0 ? "10.0.0.6:7777" : "first.example:7777", Whereabouts::kSettled) ==
          Sent::kFollows);
    places.welcomed({});
  }
  CHECK(places.place() == kSecond);
}

TEST_CASE("nobody follows what is no address") {
  Whereabouts places(kFirst);
  for (const char* text : {"", "/tmp/socket", "host", "http://host:1"})
    CHECK(places.moved(text, 1.0) == Sent::kNoAddress);
  CHECK(places.place() == kFirst);
}

TEST_CASE("a lost line is tried where it was, then at the hosts in turn, later and later") {
  Whereabouts places(kFirst);
  places.welcomed({"10.0.0.6:7777", "nonsense", "10.0.0.6:7777", "first.example:7777", "[2001:db8::7]:7778"});
  CHECK(places.has_others());
  CHECK(places.lost(60.0, 0.5) == Approx(0.05));
  CHECK(places.place() == kFirst);
  CHECK(places.lost(std::nullopt, 0.5) == Approx(0.1));
  CHECK(places.place() == kSecond);
  CHECK(places.lost(std::nullopt, 0.5) == Approx(0.2));
  CHECK(places.place() == kThird);
  CHECK(places.lost(std::nullopt, 0.0) == Approx(0.2));
  CHECK(places.place() == kFirst);
  for (int k = 0; k < 40; ++k) places.lost(std::nullopt, 0.5);
  CHECK(places.lost(std::nullopt, 0.0) == Approx(1.0));
  CHECK(places.lost(std::nullopt, 1.0) == Approx(3.0));
}

TEST_CASE("a line that breaks again at once is waited for as long as before, one that has stayed is not") {
  Whereabouts places(kFirst);
  CHECK(places.lost(60.0, 0.5) == Approx(0.05));
  places.welcomed({});
  CHECK(places.lost(0.2, 0.5) == Approx(0.1));
  places.welcomed({});
  CHECK(places.lost(6.0, 0.5) == Approx(0.05));
}

TEST_CASE("who is sent on for long remembers no more than some") {
  Whereabouts places(kFirst);
  for (int k = 1; k < 100; ++k) {
    CHECK(places.moved("10.0.0." + std::to_string(k) + ":7777", std::nullopt) == Sent::kFollows);
    places.lost(1.0, 0.5);
  }
  CHECK(places.place() == HostAddress{"10.0.0.99", 7777});
}

TEST_CASE("a hello with hosts that are none, or with too many of them, is refused") {
  Hello hello;
  for (std::size_t k = 0; k < kMaxHosts; ++k) hello.hosts.push_back("10.0.0.6:" + std::to_string(k + 1));
  const auto decode = [&hello] { return decode_server(encode(ServerMessage(hello)), {}, Format::kExact); };
  const auto back = decode();
  if (!back) FAIL(back.error().text);
  CHECK(std::get<Hello>(*back) == hello);
  hello.hosts.emplace_back("10.0.0.6:17");
  REQUIRE_FALSE(decode());
  CHECK(decode().error().text.find("hello.hosts[16]") == 0);
  hello.hosts = {"10.0.0.6:7777", "/tmp/socket"};
  REQUIRE_FALSE(decode());
  CHECK(decode().error().text.find("hello.hosts[1]") == 0);
  hello.hosts.clear();
  CHECK(encode(ServerMessage(hello)).find("hosts") == std::string::npos);
}

TEST_CASE("a ping's hosts are read as strictly, and a client's ping has none") {
  const auto decode = [](std::string_view hosts) {
    return decode_server(R"({"type":"ping","t":1,"hosts":)" + std::string(hosts) + "}", {}, Format::kExact);
  };
  CHECK(std::get<Ping>(*decode("[]")).hosts == std::vector<std::string>{});
  for (const char* wrong : {"null", "{}", "\"10.0.0.6:7777\"", "[\"/tmp/socket\"]", "[7777]"}) {
    REQUIRE_FALSE(decode(wrong));
    CHECK(decode(wrong).error().text.find("ping.hosts") == 0);
  }
  CHECK(encode(ClientMessage(Ping{1, {{"10.0.0.6:7777"}}})).find("hosts") == std::string::npos);
}
