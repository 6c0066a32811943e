#include "server/access/bans.h"

#include <catch2/catch.hpp>

#include <string>

#include "server/access/doorman.h"

namespace woodlouse::server::bans_test {

namespace {

namespace ip = boost::asio::ip;
using std::chrono::seconds;

const WallTime kNow{seconds(1'767'225'600)};

std::string canonical(const std::string& text) {
  const auto range = AddressRange::parse(text);
  return range ? range->text() : "none";
}

bool holds(const std::string& range, const std::string& address) {
  return AddressRange::parse(range)->contains(ip::make_address(address));
}

Ban ban(const std::string& who, std::optional<WallTime> until = {}) { return *Bans::parse(who, kNow, until); }

}  // namespace

TEST_CASE("addresses and networks are read, and written back in one way") {
  CHECK(canonical("192.0.2.7") == "192.0.2.7");
  CHECK(canonical("192.0.2.7/24") == "192.0.2.0/24");
  CHECK(canonical("192.0.2.7/32") == "192.0.2.7");
  CHECK(canonical("10.0.0.0/8") == "10.0.0.0/8");
  CHECK(canonical("::ffff:192.0.2.7") == "192.0.2.7");
  CHECK(canonical("2001:db8::1") == "2001:db8::/64");
  CHECK(canonical("2001:db8::1/128") == "2001:db8::/64");
  CHECK(canonical("2001:DB8:1::/48") == "2001:db8:1::/48");
  for (const char* none : {"", "ann", "192.0.2", "192.0.2.7/", "192.0.2.7/33", "192.0.2.7/-1", "192.0.2.7/8x",
                           "0.0.0.0/0", "1.0.0.0/7", "::/0", "2001::/15", "2001:db8::/129",
                           "::ffff:0.0.0.0/90", "192.0.2.7/24/24", " 192.0.2.7"})
    CHECK(canonical(none) == "none");
}

TEST_CASE("a network holds its addresses and no others") {
  CHECK(holds("192.0.2.0/24", "192.0.2.255"));
  CHECK(holds("192.0.2.0/24", "::ffff:192.0.2.1"));
  CHECK_FALSE(holds("192.0.2.0/24", "192.0.3.0"));
  CHECK_FALSE(holds("192.0.2.0/24", "2001:db8::1"));
  CHECK(holds("2001:db8::1", "2001:db8::ffff:1"));  // of one network
  CHECK_FALSE(holds("2001:db8::1", "2001:db8:0:1::1"));
  CHECK(holds("2001:db8::/32", "2001:db8:ffff::1"));
  CHECK_FALSE(holds("2001:db8::/32", "192.0.2.1"));
}

TEST_CASE("what is neither an address nor short enough for a name is no ban") {
  CHECK(Bans::parse(std::string(24, 'a'), kNow, {}));
  CHECK_FALSE(Bans::parse(std::string(25, 'a'), kNow, {}));
  for (const char* slip : {"1.2.3/8", "192.0.2.256", "192.0.2.7:5000", "10.0.0", "::1::", "/24"})
    CHECK_FALSE(Bans::parse(slip, kNow, {}));
  CHECK(ban("2024").name == "2024");
  CHECK(ban("2001:db8:1234:5678:9abc:def0:1234:5678/64").range->text() == "2001:db8:1234:5678::/64");
}

TEST_CASE("a ban holds until it is over, and the longest of several is said") {
  Bans bans;
  REQUIRE(bans.add(ban("192.0.2.0/24", kNow + seconds(60))));
  REQUIRE(bans.add(ban("192.0.2.7", kNow + seconds(10))));
  const auto address = ip::make_address("192.0.2.7");
  REQUIRE(bans.of(address, kNow) != nullptr);
  CHECK(bans.of(address, kNow)->who() == "192.0.2.0/24");
  CHECK(bans.of(address, kNow + seconds(59)) != nullptr);
  CHECK(bans.of(address, kNow + seconds(60)) == nullptr);
  CHECK(bans.of(ip::make_address("192.0.3.7"), kNow) == nullptr);
  bans.drop_over(kNow + seconds(10));
  CHECK(bans.all().size() == 1);
}

TEST_CASE("a name is banned in any case, and one ban takes another's place") {
  Bans bans;
  REQUIRE(bans.add(ban("Ann")));
  REQUIRE(bans.add(ban("ANN", kNow + seconds(5))));
  REQUIRE(bans.all().size() == 1);
  CHECK(bans.of("ann", kNow) != nullptr);
  CHECK(bans.of("anna", kNow) == nullptr);
  CHECK(bans.of("ann#2", kNow) != nullptr);
  CHECK(bans.of("ann#", kNow) == nullptr);
  CHECK(bans.of("ann#2b", kNow) == nullptr);
  CHECK(bans.of("ann", kNow + seconds(5)) == nullptr);
  CHECK(bans.remove(ban("aNN")));
  CHECK_FALSE(bans.remove(ban("ann")));
}

TEST_CASE("there is an end to how many bans there are") {
  Bans bans;
  for (std::size_t k = 0; k < Bans::kMost; ++k) REQUIRE(bans.add(ban("name" + std::to_string(k))));
  CHECK_FALSE(bans.add(ban("one more")));
  CHECK(bans.add(ban("name0", kNow)));  // in place of one
}

TEST_CASE("a slip in a network is no name") {
  CHECK_FALSE(Bans::parse("192.0.2.0/99", kNow, {}));
  CHECK_FALSE(Bans::parse("0.0.0.0/0", kNow, {}));
  CHECK(ban("ann/24").name == "ann/24");
}

TEST_CASE("a time is said as clocks on walls do") {
  CHECK(utc_text(kNow) == "2026-01-01 00:00:00 UTC");
  CHECK(until_text({}) == "for good");
  CHECK(until_text(kNow + seconds(3661)) == "until 2026-01-01 01:01:01 UTC");
}

TEST_CASE("the doorman keeps out who is banned and lets nobody speak who is muted") {
  Doorman doorman;
  CHECK_FALSE(doorman.why_not_connect(ip::make_address("192.0.2.7"), kNow));
  Bans bans;
  REQUIRE(bans.add(ban("192.0.2.7", kNow + seconds(60))));
  REQUIRE(bans.add(ban("ann")));
  doorman.use(bans);
  const auto refusal = doorman.why_not_connect(ip::make_address("192.0.2.7"), kNow);
  REQUIRE(refusal);
  CHECK(refusal->code == "banned");
  CHECK(refusal->fatal);
  CHECK(refusal->text == "the operator has banned your address until 2026-01-01 00:01:00 UTC");
  protocol::Join join;
  join.name = "ann";
  CHECK(doorman.why_not_join(join, kNow, {})->code == "banned");
  join.name = "bob";
  CHECK_FALSE(doorman.why_not_join(join, kNow, {}));

  const AddressRange range = *AddressRange::parse("2001:db8::/48");
  doorman.mute({range, kNow + seconds(60)}, kNow);
  CHECK_FALSE(doorman.why_not_speak("192.0.2.7", kNow));
  CHECK(doorman.why_not_speak("2001:db8:0:1::/64", kNow)->code == "muted");
  CHECK_FALSE(doorman.why_not_speak("2001:db8:0:1::/64", kNow + seconds(60)));
  CHECK(doorman.unmute(range) == 1);
  CHECK(doorman.unmute(range) == 0);
  CHECK_FALSE(doorman.why_not_speak("2001:db8:0:1::/64", kNow));
}

TEST_CASE("by which of this machine's networks an address came is no part of it") {
  Bans bans;
  const auto ban = Bans::parse("fe80::/16", kNow, std::nullopt);
  REQUIRE(ban);
  REQUIRE(bans.add(*ban));
  CHECK(bans.of(ip::make_address_v6("fe80::1%1"), kNow) != nullptr);
  CHECK(bans.of(*AddressRange::parse("fe80::1%1"), kNow) != nullptr);
  CHECK(AddressRange::parse("fe80::1%1") == AddressRange::parse("fe80::1"));
}

TEST_CASE("a server that drains takes those alone who come back") {
  Doorman doorman;
  CHECK_FALSE(doorman.is_draining());
  doorman.drain(kNow + seconds(30));
  CHECK(doorman.is_draining());
  const auto refusal = doorman.why_no_newcomer(kNow);
  REQUIRE(refusal);
  CHECK(refusal->code == "draining");
  CHECK_FALSE(refusal->fatal);
  CHECK(refusal->text == "join: the server stops in 30 s and takes nobody any more");
}

TEST_CASE("mutes are bounded: the oldest goes") {
  Doorman doorman;
  const auto address = [](std::size_t k) {
    return "10.0." + std::to_string(k / 256) + "." + std::to_string(k % 256);
  };
  for (std::size_t k = 1; k <= Doorman::kMostMutes + 1; ++k)
    doorman.mute({*AddressRange::parse(address(k)), kNow + seconds(60)}, kNow);
  CHECK_FALSE(doorman.why_not_speak(address(1), kNow));
  CHECK(doorman.why_not_speak(address(2), kNow));
}

}  // namespace woodlouse::server::bans_test
