#include "server/room/house_crew.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>

#include "server/room/house_bots.h"

namespace woodlouse::server {

void HouseCrew::reserve(std::uint32_t bots, const match::Match& game, bots::Skill skill,
                        std::unique_ptr<bots::Team> team) {
  by_turn_.clear();
  team_.reset();
  seats_.clear();
  by_turn_.resize(std::max(1u, game.settings().tick_hz / HouseBot::kDecisionsPerSecond));
  for (auto& turn : by_turn_) turn.reserve(bots / by_turn_.size() + 1);
  mode_ = game.settings().mode;
  if (mode_ == state::Mode::kRoam || bots == 0) return;
  team_ = team ? std::move(team) : std::make_unique<bots::Team>(game.map(), game.settings(), skill, bots);
}

std::string HouseCrew::name_of(std::uint32_t number, const HouseBot& bot) const {
  return team_ ? bots::player_name(mode_, number) : bot.name();
}

void HouseCrew::take(Seat& seat) {
  assert(!by_turn_.empty() && std::holds_alternative<BotOccupant>(seat.occupant));
  if (!team_) return by_turn_[seat.louse % by_turn_.size()].push_back(&seat);
  team_->take(seat.louse, std::get<BotOccupant>(seat.occupant).number, seat.next_seq);
  seats_[seat.louse] = &seat;
}

std::span<Seat* const> HouseCrew::steer(match::Match& game) {
  respawned_.clear();
  if (!team_) {
    roam(game);
  } else {
    for (const match::PlayerId louse : team_->steer(game)) respawned_.push_back(seats_.at(louse));
  }
  return respawned_;
}

void HouseCrew::roam(match::Match& game) {
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
