// What a player's camera shows, as a server is asked for it.
#pragma once

#include <array>
#include <cstddef>

#include "client/play/interface.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// In rooms of fewer lice everybody is shown: what is out of the picture costs little, and ranks are known.
inline constexpr std::size_t kCrowd = 100;

/// The part of a crowded room that a following camera may come to show before its louse leaves the middle;
/// all while the whole map, or the scoreboard, is looked at. extent: Welcome's [m]. lice: in the room.
protocol::View outlook(const Interface& interface, const std::array<double, 4>& extent, std::size_t lice);

}  // namespace woodlouse::client
