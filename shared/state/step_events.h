// What happened to a louse in a step, one bit each: for the rules of play and figures; no part of the state.
#pragma once

#include <cstdint>

namespace woodlouse::state {

using StepEvents = std::uint8_t;

inline constexpr StepEvents kMetWall = 1u << 0;      ///< was thrown back by one
inline constexpr StepEvents kCrossedSeam = 1u << 1;  ///< goes on at the opposite rim
inline constexpr StepEvents kTookOff = 1u << 2;
inline constexpr StepEvents kLanded = 1u << 3;
inline constexpr StepEvents kStopped = 1u << 4;  ///< came to rest
inline constexpr StepEvents kLeft = 1u << 5;     ///< is at an open edge, which ended its motion

}  // namespace woodlouse::state
