#include "server/room/room_budgets.h"

#include <catch2/catch.hpp>

using namespace woodlouse;
using namespace woodlouse::server;
using std::chrono::milliseconds;
using std::chrono::seconds;

TEST_CASE("a room's last second's worth is for addresses that have had nothing lately") {
  constexpr std::uint32_t kASecond = 4;
  constexpr AddressId kMany = 1, kOther = 2;
  protocol::Limits limits;
  limits.chat_per_s_room = kASecond;
  const Time begin{seconds(5)};
  RoomBudgets budgets(limits, begin);
  std::uint32_t had = 0;
  while (!budgets.spend(Spending::kChat, kMany, begin)) ++had;
  CHECK(had == kASecond * (protocol::kSavedSeconds - 1));
  CHECK(budgets.spend(Spending::kChat, kMany, begin) == milliseconds(250));
  CHECK_FALSE(budgets.spend(Spending::kChat, kOther, begin));
  CHECK(budgets.spend(Spending::kChat, kOther, begin));
  CHECK_FALSE(budgets.spend(Spending::kRespawn, kOther, begin));
  SECTION("which they have again after two seconds of silence") {
    for (AddressId other = 3; other <= 5; ++other) CHECK_FALSE(budgets.spend(Spending::kChat, other, begin));
    CHECK(budgets.spend(Spending::kChat, 6, begin) == milliseconds(250));
    const Time later = begin + seconds(2);
    while (!budgets.spend(Spending::kChat, kMany, later)) continue;
    CHECK_FALSE(budgets.spend(Spending::kChat, kOther, later));
  }
}
