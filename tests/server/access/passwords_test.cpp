#include "server/access/passwords.h"

#include <catch2/catch.hpp>

#include <string>

#include "server/access/doorman.h"

namespace woodlouse::server::passwords_test {

namespace {

constexpr const char* kFile =
    "# of the house\n"
    "\n"
    "player     correct-horse   # everybody's\r\n"
    "player\tanother-horse\n"
    "moderator  staple-of-it\n"
    "admin      battery-of-it";

protocol::Join join_with(const std::string& token) {
  protocol::Join join;
  join.name = "ann";
  join.token = token;
  return join;
}

std::string code_of(const Doorman::Refusal& refusal) { return refusal ? refusal->code : "none"; }

}  // namespace

TEST_CASE("a token gives the role of its line") {
  const auto passwords = Passwords::parse(kFile, "file");
  REQUIRE(passwords);
  CHECK(passwords->right_of("correct-horse") == Right::kPlayer);
  CHECK(passwords->right_of("another-horse") == Right::kPlayer);
  CHECK(passwords->right_of("staple-of-it") == Right::kModerator);
  CHECK(passwords->right_of("battery-of-it") == Right::kAdmin);
  for (const char* none : {"", "correct-hors", "correct-horse ", "everybody's", "player"})
    CHECK_FALSE(passwords->right_of(none));
}

TEST_CASE("a line of passwords that can't be taken is named, and what is in it not shown") {
  for (const char* text : {"king correct-horse", "player", "player short", "player correct-horse and-more",
                           "player correct-horse\nadmin correct-horse", "correct-horse",
                           "player corr\xc3\xa9"
                           "ct-horse"}) {
    const auto passwords = Passwords::parse(std::string("moderator staple-of-it\n") + text, "file");
    INFO(text);
    REQUIRE_FALSE(passwords);
    CHECK(passwords.error().where.starts_with("file:"));
    CHECK(passwords.error().text().find("horse") == std::string::npos);
  }
  CHECK_FALSE(Passwords::parse("", "file"));
  CHECK_FALSE(Passwords::parse("# nobody\n", "file"));
  std::string many;
  for (std::size_t k = 0; k <= Passwords::kMost; ++k) many += "player token-" + std::to_string(k) + "\n";
  CHECK_FALSE(Passwords::parse(many, "file"));
}

TEST_CASE("wrong tokens are limited by address, and those of others are looked at") {
  WrongTokens wrong;
  Time now{};
  for (int k = 0; k < 5; ++k) {
    CHECK(wrong.wait("192.0.2.7", now) == Duration{});
    wrong.count("192.0.2.7", now);
  }
  CHECK(wrong.wait("192.0.2.7", now) > Duration{});
  CHECK(wrong.wait("192.0.2.8", now) == Duration{});
  now += std::chrono::seconds(11);
  CHECK(wrong.wait("192.0.2.7", now) == Duration{});
}

TEST_CASE("what is remembered of wrong tokens is bounded") {
  WrongTokens wrong;
  Time now{};
  for (std::size_t k = 0; k < WrongTokens::kMostAddresses; ++k) wrong.count("a" + std::to_string(k), now);
  for (int k = 0; k < 5; ++k) wrong.count("late" + std::to_string(k), now);
  CHECK(wrong.wait("later", now) > Duration{});  // counted together
  now += std::chrono::hours(1);
  CHECK(wrong.wait("later", now) == Duration{});
}

TEST_CASE("who joins needs a token where there are passwords, and tells it to nobody on the way") {
  Doorman doorman;
  const WallTime wall{};
  CHECK(code_of(doorman.why_not_join(join_with("anything"), wall, {})) == "none");
  CHECK(doorman.right_of("anything") == Right::kPlayer);
  doorman.use(*Passwords::parse(kFile, "file"), Doorman::Plain::kRefused);
  Doorman::Comer comer{"192.0.2.7", true, {}};
  CHECK(code_of(doorman.why_not_join(join_with(""), wall, comer)) == "bad_token");
  CHECK(code_of(doorman.why_not_join(join_with("correct-horse"), wall, comer)) == "none");
  CHECK(doorman.right_of("staple-of-it") == Right::kModerator);
  comer.is_confidential = false;
  CHECK(code_of(doorman.why_not_join(join_with("correct-horse"), wall, comer)) == "bad_token");
  doorman.use(*Passwords::parse(kFile, "file"), Doorman::Plain::kAllowed);
  CHECK(code_of(doorman.why_not_join(join_with("correct-horse"), wall, comer)) == "none");
  for (int k = 0; k < 5; ++k)
    CHECK(code_of(doorman.why_not_join(join_with("guess" + std::to_string(k)), wall, comer)) == "bad_token");
  const auto limited = doorman.why_not_join(join_with("correct-horse"), wall, comer);
  REQUIRE(code_of(limited) == "rate_limited");
  CHECK(limited->retry_after_ms.value_or(0) > 0);
  comer.address = "192.0.2.8";
  CHECK(code_of(doorman.why_not_join(join_with("correct-horse"), wall, comer)) == "none");
}

}  // namespace woodlouse::server::passwords_test
