// How many players, bots and spectators a room has places for, and who has them.
// Pure. One owner, no locking.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include "server/frames/layouts.h"
#include "shared/protocol/limits.h"
#include "shared/state/role.h"

namespace woodlouse::server {

/// The last of each kind, kReserve of all, are for addresses that have nobody here: a few can't keep out
/// everybody else.
class Places {
 public:
  static constexpr std::uint32_t kReserve = 20;  ///< one in so many

  /// Whether one more finds a place.
  [[nodiscard]] bool has_one(state::Role role, AddressId address, const protocol::Limits& limits) const;
  void take(state::Role role, AddressId address);
  void give_back(state::Role role, AddressId address);

 private:
  std::array<std::uint32_t, 3> taken_{};
  std::map<AddressId, std::uint32_t> of_address_;
};

/// The limit of that role.
[[nodiscard]] std::uint32_t places_of(state::Role role, const protocol::Limits& limits);

}  // namespace woodlouse::server
