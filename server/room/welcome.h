// What a newcomer is told of a room and its map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "server/frames/frame.h"
#include "server/frames/row_table.h"
#include "server/room/room_settings.h"
#include "server/room/seats.h"
#include "shared/map/map_definition.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// What a welcome says to its session alone.
struct Addressee {
  match::PlayerId louse = 0;
  std::string name;
  std::string resume_token;
  RowLayout layout;
  std::uint32_t state_hz = 0;
  protocol::Stream stream = protocol::Stream::kFrames;
};
/// REQUIRES that the seat is a session's.
Addressee addressee_of(const Seat& seat, const RowLayout& layout);

/// All but the addressee, who else is there, and whether it came back. map_bytes: of the map's line.
protocol::Welcome welcome_for(const RoomSettings& settings, const match::Match& game, std::size_t map_bytes);
/// The same, to that one.
protocol::Welcome addressed(protocol::Welcome welcome, const Addressee& to);

/// The `map` message, made once a game: the definition, the knots where it only names a function, and an
/// overview where it names a file.
Line encode_map_line(const map::Map& map);

/// Frames a second of a spectator who asks for no rate, where he watches by inputs, is shown a part of the
/// room or came by the web port.
inline constexpr std::uint32_t kLookersHz = 10;
/// What a join asks for, said or not.
std::optional<std::uint32_t> wanted_state_hz(const protocol::Join& join, bool is_web);

/// The largest divisor of `most` that does not exceed `wanted`, so that keys stay a second apart.
std::uint32_t granted_state_hz(std::optional<std::uint32_t> wanted, std::uint32_t most);

}  // namespace woodlouse::server
