#include "server/timing/budgets.h"

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {
const Time kBegin{seconds(5)};
}

TEST_CASE("a clock that stands still or goes back gives no tokens") {
  TokenBucket bucket(10, 1, kBegin);
  CHECK(bucket.take(1, kBegin));
  CHECK_FALSE(bucket.take(1, kBegin - seconds(10)));
  CHECK_FALSE(bucket.take(1, kBegin));
}

TEST_CASE("a budget gives its saved seconds at once, then its rate, and says how long to wait") {
  protocol::Limits limits;
  limits.chat_per_s = 2;
  Budgets budgets(session_rates(limits), kBegin);
  for (std::uint32_t k = 0; k < 2 * protocol::kSavedSeconds; ++k)
    REQUIRE_FALSE(budgets.spend(Spending::kChat, kBegin));
  CHECK(budgets.spend(Spending::kChat, kBegin) == milliseconds(500));
  CHECK_FALSE(budgets.spend(Spending::kChat, kBegin + milliseconds(500)));
  CHECK(budgets.spend(Spending::kChat, kBegin + milliseconds(500)) == milliseconds(500));
  CHECK_FALSE(budgets.spend(Spending::kRespawn, kBegin));
}

TEST_CASE("what is bigger than all that is there is given, and the next waits until it is paid off") {
  protocol::Limits limits;
  limits.answer_bytes_per_s = 1000;
  Budgets budgets(session_rates(limits), kBegin);
  CHECK(budgets.wait(Spending::kAnswerBytes, kBegin) == Duration{});
  budgets.charge(Spending::kAnswerBytes, 9999, kBegin);
  CHECK(budgets.wait(Spending::kAnswerBytes, kBegin) == seconds(2));
  CHECK(budgets.wait(Spending::kAnswerBytes, kBegin + seconds(2)) == Duration{});
  CHECK_FALSE(budgets.are_full(kBegin + seconds(9)));
  CHECK(budgets.are_full(kBegin + seconds(10)));
}

TEST_CASE("a rate of 0 forbids, what has none is not bounded, and no wait is longer than an hour") {
  protocol::Limits limits;
  limits.chat_per_s = 0;
  Budgets budgets(session_rates(limits), kBegin);
  CHECK(budgets.spend(Spending::kChat, kBegin) == hours(1));
  CHECK(budgets.spend(Spending::kChat, kBegin + hours(24)) == hours(1));
  for (int k = 0; k < 10'000; ++k) REQUIRE_FALSE(budgets.spend(Spending::kLogLines, kBegin));
  CHECK(retry_after_ms(Duration{}) == 1);
  CHECK(retry_after_ms(milliseconds(250)) == 250);
}

TEST_CASE("each rate is that of its limit") {
  protocol::Limits limits;
  std::uint32_t next = 11;
  for (std::uint32_t* limit :
       {&limits.chat_per_s, &limits.chat_per_s_address, &limits.chat_per_s_room, &limits.respawn_per_s,
        &limits.respawn_per_s_address, &limits.respawn_per_s_room, &limits.join_per_s_address,
        &limits.join_per_s_room, &limits.answer_bytes_per_s, &limits.answer_bytes_per_s_address})
    *limit = next++;
  CHECK(session_rates(limits)[0] == 11.0);
  CHECK(session_rates(limits)[1] == 14.0);
  CHECK_FALSE(session_rates(limits)[2]);  // a session joins once
  CHECK(session_rates(limits)[3] == 19.0);
  CHECK(address_rates(limits)[0] == 12.0);
  CHECK(address_rates(limits)[1] == 15.0);
  CHECK(address_rates(limits)[2] == 17.0);
  CHECK(address_rates(limits)[3] == 20.0);
  CHECK(address_rates(limits)[4]);
  CHECK(room_rates(limits)[0] == 13.0);
  CHECK(room_rates(limits)[1] == 16.0);
  CHECK(room_rates(limits)[2] == 18.0);
}
