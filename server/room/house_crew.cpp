#include "server/room/house_crew.h"

#include <algorithm>
#include <cassert>
#include <variant>

#include "server/room/house_bots.h"

namespace woodlouse::server {

void HouseCrew::reserve(std::uint32_t bots, std::uint32_t tick_hz) {
  assert(by_turn_.empty());
  by_turn_.resize(std::max(1u, tick_hz / HouseBot::kDecisionsPerSecond));
  for (auto& turn : by_turn_) turn.reserve(bots / by_turn_.size() + 1);
}

void HouseCrew::take(Seat& seat) {
  assert(!by_turn_.empty() && std::holds_alternative<BotOccupant>(seat.occupant));
  by_turn_[seat.louse % by_turn_.size()].push_back(&seat);
}

void HouseCrew::steer(match::Match& game) {
  assert(!by_turn_.empty());
  const std::uint64_t period = by_turn_.size();
  const auto& world = game.world();
  for (Seat* seat : by_turn_[(period - game.tick() % period) % period]) {
    const state::Louse* louse = world.find(seat->louse);
    if (louse == nullptr) continue;
    HouseBot& bot = std::get<BotOccupant>(seat->occupant).bot;
    const state::Thrust thrust = bot.decide({*louse, world.terrain(), world.parameters()});
    game.file({seat->louse, seat->next_seq++, thrust, state::kHeld, 0});
  }
}

}  // namespace woodlouse::server
