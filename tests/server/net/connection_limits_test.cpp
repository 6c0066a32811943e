#include "server/net/connection_limits.h"

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;
using Admission = ConnectionLimits::Admission;
using boost::asio::ip::make_address;

namespace {

const Time kNow{std::chrono::seconds(100)};

struct Limited {
  explicit Limited(std::uint32_t per_address, std::uint32_t in_all = 10'000)
      : live(of(per_address, in_all)) {}
  static protocol::Limits of(std::uint32_t per_address, std::uint32_t in_all) {
    protocol::Limits limits;
    limits.per_address = per_address;
    limits.max_connections = in_all;
    return limits;
  }
  Admission admit(const std::string& key) { return limits.admit(key, kNow); }

  LiveLimits live;
  ConnectionLimits limits{live};
};

}  // namespace

TEST_CASE("an address gets its share, a few more are told, the rest are dropped, others are not touched") {
  Limited house(3);
  for (int i = 0; i < 3; ++i) CHECK(house.admit("a") == Admission::kWelcome);
  for (std::uint32_t i = 0; i < ConnectionLimits::kCourtesy; ++i)
    CHECK(house.admit("a") == Admission::kAddressFull);
  CHECK(house.admit("a") == Admission::kDrop);
  CHECK(house.admit("b") == Admission::kWelcome);
}

TEST_CASE("who leaves makes room, and a dropped connection was never counted") {
  Limited house(1);
  CHECK(house.admit("a") == Admission::kWelcome);
  for (std::uint32_t i = 0; i < ConnectionLimits::kCourtesy; ++i) house.admit("a");
  for (int i = 0; i < 100; ++i) CHECK(house.admit("a") == Admission::kDrop);
  for (std::uint32_t i = 0; i < ConnectionLimits::kCourtesy + 1; ++i) house.limits.release("a", kNow);
  CHECK(house.admit("a") == Admission::kWelcome);
}

TEST_CASE("connections of a proxy that has not said whose they are count against the server's limit alone") {
  Limited house(2, 100);
  for (int i = 0; i < 100; ++i) REQUIRE(house.limits.admit_unknown("proxy a", kNow) == Admission::kWelcome);
  for (std::uint32_t i = 0; i < ConnectionLimits::kCourtesy; ++i)
    CHECK(house.limits.admit_unknown("proxy a", kNow) == Admission::kServerFull);
  CHECK(house.limits.admit_unknown("proxy a", kNow) == Admission::kDrop);
  CHECK(house.admit("b") == Admission::kDrop);
  house.limits.release("proxy a", kNow);  // that very one is another's now, or a further one
  CHECK(house.admit("b") == Admission::kServerFull);
  for (std::uint32_t i = 0; i <= ConnectionLimits::kCourtesy; ++i) house.limits.release("proxy a", kNow);
  CHECK(house.limits.admit_unknown("proxy a", kNow) == Admission::kWelcome);
}

TEST_CASE("a few addresses can't take all connections: the last twentieth is for those that have none") {
  Limited house(1000, 100);
  for (int i = 0; i < 95; ++i) REQUIRE(house.admit(i % 2 == 0 ? "a" : "b") == Admission::kWelcome);
  CHECK(house.admit("a") == Admission::kServerFull);
  house.limits.release("a", kNow);
  CHECK(house.admit("c") == Admission::kWelcome);
  CHECK(house.admit("c") == Admission::kServerFull);
  house.limits.release("c", kNow);
  for (const char* key : {"d", "e", "f", "g"}) CHECK(house.admit(key) == Admission::kWelcome);
  CHECK(house.admit("h") == Admission::kServerFull);
}

TEST_CASE("an address's account outlives its connections while it has something to remember") {
  Limited house(3);
  house.admit("a");
  const AddressId id = house.limits.account("a")->id();
  house.limits.account("a")->charge(Spending::kChat, 5.0, kNow);
  house.limits.release("a", kNow);
  house.admit("a");
  CHECK(house.limits.account("a")->id() == id);
  house.limits.release("a", kNow);
  CHECK(house.limits.addresses() == 1);
  const Time later = kNow + std::chrono::minutes(1);
  house.limits.admit("b", later);
  CHECK(house.limits.addresses() == 1);
  house.limits.admit("a", later);
  CHECK(house.limits.account("a")->id() != id);
}

TEST_CASE("of what is logged about an address the rest is counted") {
  AddressAccount account(1, "10.0.0.1", {}, kNow);
  std::uint64_t logged = 0;
  for (int k = 0; k < 1000; ++k) logged += account.take_log_line(kNow) ? 1 : 0;
  CHECK(logged < 50);
  CHECK_FALSE(account.is_at_rest(kNow + std::chrono::hours(1)));
  CHECK(account.take_log_line(kNow + std::chrono::seconds(1)) == 1000 - logged);
  CHECK(account.take_log_line(kNow + std::chrono::seconds(1)) == 0);
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

TEST_CASE("of an address's connections only some may speak HTTP at a time") {
  Limited house(256);
  ConnectionLimits& connections = house.limits;
  for (std::uint32_t k = 0; k < ConnectionLimits::kMostHttp; ++k) {
    REQUIRE(house.admit("10.0.0.1") == Admission::kWelcome);
    CHECK(connections.take_http("10.0.0.1"));
  }
  REQUIRE(house.admit("10.0.0.1") == Admission::kWelcome);
  REQUIRE(house.admit("10.0.0.2") == Admission::kWelcome);
  CHECK_FALSE(connections.take_http("10.0.0.1"));
  CHECK(connections.take_http("10.0.0.2"));
  connections.give_http_back("10.0.0.1");
  CHECK(connections.take_http("10.0.0.1"));
}
