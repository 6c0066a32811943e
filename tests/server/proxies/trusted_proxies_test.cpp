#include "server/proxies/trusted_proxies.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace woodlouse::server::trusted_proxies_test {

namespace {

namespace ip = boost::asio::ip;

TrustedProxies trusting(const std::vector<std::string>& texts) {
  std::vector<ProxyNetwork> networks;
  for (const std::string& text : texts) {
    const auto network = checked_proxy(text);
    REQUIRE(network);
    networks.push_back(*network);
  }
  return TrustedProxies(networks);
}

bool contains(const TrustedProxies& proxies, const char* address) {
  return proxies.contains(ip::make_address(address));
}

std::string behind(const TrustedProxies& proxies, const std::string& forwarded) {
  const auto address = proxies.behind(forwarded);
  return address ? address->to_string() : "";
}

}  // namespace

TEST_CASE("trusted proxies are addresses and networks, to the bit") {
  const TrustedProxies proxies =
      trusting({"10.0.0.7", "192.0.2.64/26", "172.16.1.0/23", "fd00:12::/61", "::1"});
  for (const char* address : {"10.0.0.7", "::ffff:10.0.0.7", "192.0.2.64", "192.0.2.127", "172.16.0.255",
                              "172.16.1.1", "fd00:12:0:7::1", "::1"}) {
    INFO(address);
    CHECK(contains(proxies, address));
  }
  for (const char* address : {"10.0.0.6", "192.0.2.63", "192.0.2.128", "172.16.2.0", "fd00:12:0:8::1", "::2",
                              "0.0.0.1", "::a00:7"}) {
    INFO(address);
    CHECK_FALSE(contains(proxies, address));
  }
  CHECK_FALSE(contains(TrustedProxies(), "127.0.0.1"));
}

TEST_CASE("what is no proxy's address or network is refused, and so is everybody") {
  for (const char* text :
       {"", "proxy.example.org", "10.0.0", "10.0.0.7/", "10.0.0.7/33", "10.0.0.7/-1", "10.0.0.7/8 ",
        "::1/129", "10.0.0.7:80", "/8", "0.0.0.0/0", "::/0", "10.0.0.7/8/8"}) {
    INFO(text);
    const auto network = checked_proxy(text);
    REQUIRE_FALSE(network);
    CHECK(network.error().where == std::string("--trusted-proxy ") + text);
    CHECK_FALSE(network.error().hint.empty());
  }
}

TEST_CASE("a request is for the last one in X-Forwarded-For who is no trusted proxy") {
  const TrustedProxies proxies = trusting({"10.0.0.0/8", "fd00::/16"});
  CHECK(behind(proxies, "192.0.2.1") == "192.0.2.1");
  CHECK(behind(proxies, "203.0.113.9, 192.0.2.1") == "192.0.2.1");
  CHECK(behind(proxies, "203.0.113.9, 192.0.2.1, 10.0.0.1,10.9.9.9") == "192.0.2.1");
  CHECK(behind(proxies, "203.0.113.9,2001:db8::7 , fd00::1") == "2001:db8::7");
  CHECK(behind(proxies, "192.0.2.1:4711") == "192.0.2.1");
  CHECK(behind(proxies, "[2001:db8::7]:4711") == "2001:db8::7");
  CHECK(behind(proxies, "[2001:db8::7]") == "2001:db8::7");
  CHECK(behind(proxies, "::ffff:192.0.2.1") == "192.0.2.1");
}

TEST_CASE("where all are trusted proxies, or one is no address, it is for the last of them that is known") {
  const TrustedProxies proxies = trusting({"10.0.0.0/8"});
  CHECK(behind(proxies, "10.0.0.1, 10.0.0.2") == "10.0.0.1");
  CHECK(behind(proxies, "unknown, 10.0.0.2") == "10.0.0.2");
  CHECK(behind(proxies, "192.0.2.1, , 10.0.0.2") == "10.0.0.2");
  for (const char* text : {"", " ", ",", "unknown", "192.0.2.1,", "192.0.2.1, _hidden", "192.0.2.256", "[::1",
                           "[]", "a:b", "192.0.2.1 192.0.2.2"}) {
    INFO(text);
    CHECK(behind(proxies, text).empty());
  }
}

}  // namespace woodlouse::server::trusted_proxies_test
