// A drive that can be driven again: the spawn where it began, and every input since.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shared/state/thrust.h"

namespace woodlouse::state {

/// A longer drive is no ghost: of whoever drives on and on nothing is kept.
inline constexpr std::uint32_t kMostGhostSeconds = 600;
inline constexpr std::size_t kMostGhostInputs = 20'000;

struct GhostInput {
  std::uint32_t at = 0;  ///< the step that takes it, counted from the one that began at the spawn
  Thrust thrust;
  std::uint32_t ticks = kHeld;
  friend bool operator==(const GhostInput&, const GhostInput&) = default;
};

struct Ghost {
  std::uint32_t spawn = 0;         ///< which of the mode's
  std::uint32_t ticks = 0;         ///< steps until it is done
  std::vector<GhostInput> inputs;  ///< in the order they were applied
  friend bool operator==(const Ghost&, const Ghost&) = default;
};

}  // namespace woodlouse::state
