// An encoded picture of a room at one tick, shared by all who receive it.
#pragma once

#include <cstdint>

#include "server/frames/line.h"
#include "server/frames/row_sheet.h"

namespace woodlouse::server {

enum class FrameKind : std::uint8_t {
  kKey,    ///< whole by itself
  kDelta,  ///< cumulative against the key of tick `base`; useless without it
};

struct Frame {
  FrameKind kind = FrameKind::kKey;
  std::uint64_t tick = 0;
  std::uint64_t base = 0;   ///< a key's own tick
  std::uint64_t index = 0;  ///< counts the room's frames: tick / (tick_hz / state_hz)
  Line text;
  SharedRowSheet sheet{};  ///< instead of the text: of which each client is shown a part (viewer.h)
};

}  // namespace woodlouse::server
