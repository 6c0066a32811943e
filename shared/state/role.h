// As what somebody is in a room.
#pragma once

#include <cstdint>

namespace woodlouse::state {

/// The numbers are in the state hash (match/match_state.h). A spectator has no louse.
enum class Role : std::uint8_t { kPlayer = 0, kBot = 1, kSpectator = 2 };

}  // namespace woodlouse::state
