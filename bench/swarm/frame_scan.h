// The tick of a frame's line without decoding its rows: 200 bots of 200 rows at 20 Hz are 800,000 rows a
// second, and the tool must not be what it measures.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace woodlouse::swarm {

/// The tick, when the line begins as the server's keys and deltas do; nothing for any other line.
std::optional<std::uint64_t> scan_frame_tick(std::string_view line);

}  // namespace woodlouse::swarm
