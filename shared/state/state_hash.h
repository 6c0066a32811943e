// The proof that two runs are the same: one 64-bit hash a tick, chained.
//
//     hash(n) = XXH64 over, little-endian and without gaps,
//         hash(n-1)        8 bytes
//         inputs           8 bytes   XXH64 over the inputs applied in step n-1 -> n, in the order applied
//         tick n           8 bytes
//         lice             104 bytes each, by ascending id, as in louse.h
//         generator        8 bytes   the match's random state
// Chained, so that an altered input shows even where it moved nothing.
#pragma once

#include <cstdint>
#include <span>

#include "shared/core/stable_hash.h"
#include "shared/state/louse.h"

namespace woodlouse::state {

/// What besides the lice goes into a tick's hash; with the rows of a key, enough to recompute it.
struct HashLink {
  std::uint64_t previous = 0;
  std::uint64_t inputs = 0;
  std::uint64_t tick = 0;
  std::uint64_t generator = 0;
  friend bool operator==(const HashLink&, const HashLink&) = default;
};

std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link, std::span<const Louse> lice);

}  // namespace woodlouse::state
