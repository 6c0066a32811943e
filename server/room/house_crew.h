// The house's own bots of a room, which look and push in turns: no tick pays for all of them.
// The room's strand owns it.
#pragma once

#include <cstdint>
#include <vector>

#include "server/room/seats.h"
#include "shared/match/match.h"

namespace woodlouse::server {

class HouseCrew {
 public:
  /// Before the first take().
  void reserve(std::uint32_t bots, std::uint32_t tick_hz);
  /// One more. The seat is a bot's and stays where it is.
  void take(Seat& seat);
  /// Before each tick: those whose turn it is, each ten times a second.
  void steer(match::Match& game);

 private:
  std::vector<std::vector<Seat*>> by_turn_;  ///< by the tick of a period at which they look
};

}  // namespace woodlouse::server
