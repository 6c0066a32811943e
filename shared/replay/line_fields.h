// What the fields of a recording's lines may be, besides what json/fields.h knows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "shared/json/fields.h"
#include "shared/protocol/messages.h"

namespace woodlouse::replay {

inline constexpr std::uint64_t kMaxTick = std::uint64_t{1}
                                          << 53;  ///< exact as a double; 4.7 million years at 60 Hz

inline constexpr std::uint64_t kMaxOffset = std::uint64_t{1} << 53;  ///< [bytes]
inline constexpr std::size_t kMaxTextBytes = 4096;                   ///< of a text for people

/// player, bot or spectator; reported, and a player, where it is none.
protocol::Role role_of(const json::Value& value, json::Problems& problems);

}  // namespace woodlouse::replay
