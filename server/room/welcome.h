// What a newcomer is told of a room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "server/frames/row_table.h"
#include "server/room/room_settings.h"
#include "server/room/seats.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// All but who else is there, the rate granted, and whether it came back. map_bytes: of the map's line.
protocol::Welcome welcome_for(const Seat& seat, const RowLayout& layout, const RoomSettings& settings,
                              const match::Match& game, std::size_t map_bytes);

/// The largest divisor of `most` that does not exceed `wanted`, so that keys stay a second apart.
std::uint32_t granted_state_hz(std::optional<std::uint32_t> wanted, std::uint32_t most);

}  // namespace woodlouse::server
