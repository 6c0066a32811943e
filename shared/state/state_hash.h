// The proof that two runs are the same: one 64-bit hash a tick, chained.
//
//     hash = XXH64 over, little-endian and without gaps, 8 bytes each,
//         previous     the hash before
//         inputs       XXH64 over the inputs applied in the step, in the order applied
//         roster       XXH64 over who joined, left and respawned in it, in the order applied (match_state.h)
//         rules        XXH64 over the state of the rules of play; 0 where there are none
//         tick         that the step led to
//         generator    the match's random state
//         blocks       XXH64 over each kBlockLice lice, 104 bytes each by ascending id as in louse.h; what is
//                      left at the end is a block, too
// Chained, so that an altered input shows even where it moved nothing. A step that applied nothing and
// changed no byte of lice, generator or rules makes no link: the hash stays, and the next link's tick binds
// the gap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/core/stable_hash.h"
#include "shared/core/team.h"
#include "shared/state/louse.h"

namespace woodlouse::state {

/// How many lice are hashed together: a block of which nobody changed keeps its value.
inline constexpr std::size_t kBlockLice = 64;

/// Of how many lice there are.
constexpr std::size_t block_count(std::size_t lice) { return (lice + kBlockLice - 1) / kBlockLice; }

/// What besides the lice goes into a hash; with the rows of a key, enough to recompute it. `tick` is that of
/// the last step that made a link, 0 before any.
struct HashLink {
  std::uint64_t previous = 0;
  std::uint64_t inputs = 0;
  std::uint64_t roster = 0;
  std::uint64_t rules = 0;
  std::uint64_t tick = 0;
  std::uint64_t generator = 0;
  friend bool operator==(const HashLink&, const HashLink&) = default;
};

/// The blocks' hashes, kept from step to step.
class BlockHashes {
 public:
  /// Hashes those blocks anew whose flag is not 0; `changed`: a flag a block. True when a block has another
  /// hash, or there are more or fewer. REQUIRES that the blocks without a flag are those of the last call.
  /// A team helps where many have changed; none (null) gives the same.
  bool update(std::span<const Louse> lice, std::span<const std::uint8_t> changed, core::Team* team = nullptr);
  [[nodiscard]] std::span<const std::uint64_t> values() const { return values_; }

 private:
  std::vector<std::uint64_t> values_;
};

std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link,
                         std::span<const std::uint64_t> blocks);
/// The same of lice whose blocks are not known: all are hashed.
std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link, std::span<const Louse> lice);

}  // namespace woodlouse::state
