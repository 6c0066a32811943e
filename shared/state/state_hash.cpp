#include "shared/state/state_hash.h"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace woodlouse::state {

bool BlockHashes::update(std::span<const Louse> lice, std::span<const std::uint8_t> changed) {
  const std::size_t count = block_count(lice.size());
  assert(changed.size() == count);
  bool is_another = values_.size() != count;
  values_.resize(count);
  for (std::size_t block = 0; block < count; ++block) {
    if (changed[block] == 0) continue;
    const std::size_t first = block * kBlockLice;
    const auto part = lice.subspan(first, std::min(kBlockLice, lice.size() - first));
    const std::uint64_t hash =
        core::stable_hash(std::string_view(reinterpret_cast<const char*>(part.data()), part.size_bytes()));
    is_another |= hash != values_[block];
    values_[block] = hash;
  }
  return is_another;
}

std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link,
                         std::span<const std::uint64_t> blocks) {
  hasher.reset();
  for (const std::uint64_t word :
       {link.previous, link.inputs, link.roster, link.rules, link.tick, link.generator})
    hasher.append(word);
  hasher.append(blocks);
  return hasher.value();
}

std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link, std::span<const Louse> lice) {
  BlockHashes blocks;
  blocks.update(lice, std::vector<std::uint8_t>(block_count(lice.size()), 1));
  return state_hash(hasher, link, blocks.values());
}

}  // namespace woodlouse::state
