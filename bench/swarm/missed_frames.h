// How many frames a watcher should have got between two that it got.
#pragma once

#include <cstdint>

namespace woodlouse::swarm {

/// Frames of a session are tick_hz / state_hz ticks apart. One that comes out of turn (a key after joining or
/// a resync) lies between two of them and makes no hole.
constexpr std::uint64_t missed_frames(std::uint64_t former_tick, std::uint64_t tick,
                                      std::uint64_t ticks_a_frame) {
  if (tick <= former_tick || ticks_a_frame == 0) return 0;
  const std::uint64_t due = (tick - former_tick + ticks_a_frame / 2) / ticks_a_frame;
  return due > 1 ? due - 1 : 0;
}

}  // namespace woodlouse::swarm
