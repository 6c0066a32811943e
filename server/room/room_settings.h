// What a room is opened with.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/bots/skill.h"
#include "shared/protocol/limits.h"

namespace woodlouse::server {

struct RoomSettings {
  std::string name;
  std::string build{};          ///< of the server, for who saves what he watches
  std::uint32_t state_hz = 20;  ///< divides the match's tick_hz
  std::uint32_t bots = 0;       ///< of the house
  bots::Skill bots_skill = bots::Skill::kFair;
  bool bots_alone_play = false;  ///< the house's bots keep a room awake in which nobody is
  bool adopts_by_name = false;   ///< who joins under a recorded name takes that louse over
  /// Lice of the game that it goes on from that are nobody's here go; else they stay.
  bool ends_unclaimed = false;
  std::optional<std::uint64_t> tick_limit;  ///< ends after so many, of all its games
  std::uint32_t rounds_a_game = 0;          ///< then the next one begins; 0: it plays one for good
  protocol::Limits limits{};
};

}  // namespace woodlouse::server
