// A live game that goes on from a tick of a recording, with all of its lice where and as they were.
#pragma once

#include <cstdint>
#include <filesystem>

#include "server/room/start.h"
#include "shared/core/error.h"

namespace woodlouse::server {

struct ForkPoint {
  std::filesystem::path recording;
  std::uint64_t tick = 0;
  std::filesystem::path maps{};  ///< where its map is, if it is only named; empty: beside the recording
  bool adopts_by_name = false;   ///< who joins under a recorded name takes that louse over
};

/// The match at that tick, proven up to there since the keyframe before it, which is taken on trust. Inputs
/// that waited for a later tick are those that keyframe knew; the recording has to go on to apply them.
/// Errors: no recording or a damaged one, its map is not found or another, the tick is not in it, or what was
/// recorded is not what a re-run gives.
core::Expected<Start> open_fork(const ForkPoint& point);

}  // namespace woodlouse::server
