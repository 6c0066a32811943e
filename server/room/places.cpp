#include "server/room/places.h"

#include <cassert>

namespace woodlouse::server {
namespace {

std::size_t index(state::Role role) { return static_cast<std::size_t>(role); }

}  // namespace

std::uint32_t places_of(state::Role role, const protocol::Limits& limits) {
  if (role == state::Role::kPlayer) return limits.max_players;
  return role == state::Role::kBot ? limits.max_bots : limits.max_spectators;
}

bool Places::has_one(state::Role role, AddressId address, const protocol::Limits& limits) const {
  const std::uint32_t most = places_of(role, limits);
  const std::uint32_t reserved = of_address_.contains(address) ? most / kReserve : 0;
  return taken_[index(role)] < most - reserved;
}

void Places::take(state::Role role, AddressId address) {
  ++taken_[index(role)];
  ++of_address_[address];
}

void Places::give_back(state::Role role, AddressId address) {
  const auto found = of_address_.find(address);
  assert(found != of_address_.end() && taken_[index(role)] > 0);
  --taken_[index(role)];
  if (--found->second == 0) of_address_.erase(found);
}

}  // namespace woodlouse::server
