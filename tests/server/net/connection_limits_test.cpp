#include "server/net/connection_limits.h"

#include <catch2/catch.hpp>

using namespace woodlouse::server;
using Admission = ConnectionLimits::Admission;
using boost::asio::ip::make_address;

TEST_CASE("an address gets its share, a few more are told, the rest are dropped, others are not touched") {
  ConnectionLimits limits(3);
  for (int i = 0; i < 3; ++i) CHECK(limits.admit("a") == Admission::kWelcome);
  for (std::uint32_t i = 0; i < ConnectionLimits::kCourtesy; ++i)
    CHECK(limits.admit("a") == Admission::kRefuse);
  CHECK(limits.admit("a") == Admission::kDrop);
  CHECK(limits.admit("b") == Admission::kWelcome);
}

TEST_CASE("who leaves makes room, and a dropped connection was never counted") {
  ConnectionLimits limits(1);
  CHECK(limits.admit("a") == Admission::kWelcome);
  for (std::uint32_t i = 0; i < ConnectionLimits::kCourtesy; ++i) limits.admit("a");
  for (int i = 0; i < 100; ++i) CHECK(limits.admit("a") == Admission::kDrop);
  for (std::uint32_t i = 0; i < ConnectionLimits::kCourtesy + 1; ++i) limits.release("a");
  CHECK(limits.admit("a") == Admission::kWelcome);
}

TEST_CASE("an IPv6 network of 64 bits counts as one address, a mapped IPv4 address as itself") {
  CHECK(ConnectionLimits::key(make_address("2001:db8:1:2::3")) ==
        ConnectionLimits::key(make_address("2001:db8:1:2:ffff::1")));
  CHECK(ConnectionLimits::key(make_address("2001:db8:1:2::3")) !=
        ConnectionLimits::key(make_address("2001:db8:1:3::3")));
  CHECK(ConnectionLimits::key(make_address("::ffff:10.0.0.1")) ==
        ConnectionLimits::key(make_address("10.0.0.1")));
  CHECK(ConnectionLimits::key(make_address("10.0.0.2")) != ConnectionLimits::key(make_address("10.0.0.1")));
}
