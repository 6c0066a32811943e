#include "server/net/connection_limits.h"

#include <catch2/catch.hpp>

using namespace woodlouse::server;
using Admission = AddressBook::Admission;
using boost::asio::ip::make_address;

TEST_CASE("an address gets its share, a few more are told, the rest are dropped, others are not touched") {
  AddressBook book(3);
  for (int i = 0; i < 3; ++i) CHECK(book.admit("a") == Admission::kWelcome);
  for (std::uint32_t i = 0; i < AddressBook::kCourtesy; ++i) CHECK(book.admit("a") == Admission::kRefuse);
  CHECK(book.admit("a") == Admission::kDrop);
  CHECK(book.admit("b") == Admission::kWelcome);
}

TEST_CASE("who leaves makes room, and a dropped connection was never counted") {
  AddressBook book(1);
  CHECK(book.admit("a") == Admission::kWelcome);
  for (std::uint32_t i = 0; i < AddressBook::kCourtesy; ++i) book.admit("a");
  for (int i = 0; i < 100; ++i) CHECK(book.admit("a") == Admission::kDrop);
  for (std::uint32_t i = 0; i < AddressBook::kCourtesy + 1; ++i) book.release("a");
  CHECK(book.admit("a") == Admission::kWelcome);
}

TEST_CASE("an IPv6 network of 64 bits counts as one address, a mapped IPv4 address as itself") {
  CHECK(AddressBook::key(make_address("2001:db8:1:2::3")) ==
        AddressBook::key(make_address("2001:db8:1:2:ffff::1")));
  CHECK(AddressBook::key(make_address("2001:db8:1:2::3")) !=
        AddressBook::key(make_address("2001:db8:1:3::3")));
  CHECK(AddressBook::key(make_address("::ffff:10.0.0.1")) == AddressBook::key(make_address("10.0.0.1")));
  CHECK(AddressBook::key(make_address("10.0.0.2")) != AddressBook::key(make_address("10.0.0.1")));
}
