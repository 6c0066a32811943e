// The clock of rounds that all modes share.
#pragma once

#include <cstdint>

namespace woodlouse::rules {

enum class Phase : std::uint8_t {
  kGather = 0,     ///< nobody is there; nothing passes
  kCountdown = 1,  ///< lice drive, nothing counts
  kPlay = 2,
  kPodium = 3,  ///< the table stands, lice drive
};
inline constexpr std::uint8_t kPhases = 4;

struct Round {
  Phase phase = Phase::kGather;
  std::uint32_t number = 0;  ///< of this one, from 1; 0 in gather
  std::uint64_t until = 0;   ///< the tick at which the phase ends; 0 in gather
  friend bool operator==(const Round&, const Round&) = default;
};

/// Of the modes that have a countdown [s].
inline constexpr std::uint64_t kCountdown = 3;

/// How long its phases are [ticks]; a countdown of 0 is left out, the others are above 0.
struct RoundLengths {
  std::uint64_t countdown = 0, play = 0, podium = 0;
};

}  // namespace woodlouse::rules
