#include "shared/state/state_hash.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>

namespace woodlouse::state {
namespace {

/// Blocks that changed, of which a team's member is asked for at least: 7 us side by side, 40 one by one.
constexpr std::size_t kMemberBlocks = 64;

constexpr std::size_t kBlockBytes = kBlockLice * sizeof(Louse);

/// Whole blocks that are hashed together.
constexpr std::size_t kBatch = 32;
struct Batch {
  std::array<std::size_t, kBatch> blocks;
  std::array<const char*, kBatch> texts;
  std::array<std::uint64_t, kBatch> hashes;
  std::size_t size = 0;
};

}  // namespace

bool BlockHashes::update(std::span<const Louse> lice, std::span<const std::uint8_t> changed,
                         core::Team* team) {
  const std::size_t count = block_count(lice.size());
  assert(changed.size() == count);
  std::atomic<bool> is_another = values_.size() != count;
  values_.resize(count);
  const auto hash_blocks = [&](std::size_t first, std::size_t end) {
    const auto keep = [&](std::size_t block, std::uint64_t hash) {
      if (hash != values_[block]) is_another.store(true, std::memory_order_relaxed);
      values_[block] = hash;
    };
    const auto bytes = [&](std::size_t block) {
      return reinterpret_cast<const char*>(lice.data() + block * kBlockLice);
    };
    Batch batch;
    const auto hash_batch = [&] {
      core::stable_hashes({batch.texts.data(), batch.size}, kBlockBytes, batch.hashes.data());
      for (std::size_t i = 0; i < batch.size; ++i) keep(batch.blocks[i], batch.hashes[i]);
      batch.size = 0;
    };
    for (std::size_t block = first; block < end; ++block) {
      if (changed[block] == 0) continue;
      if (const std::size_t left = lice.size() - block * kBlockLice; left < kBlockLice) {
        keep(block, core::stable_hash({bytes(block), left * sizeof(Louse)}));
        continue;
      }
      batch.texts[batch.size] = bytes(block);
      batch.blocks[batch.size++] = block;
      if (batch.size == kBatch) hash_batch();
    }
    hash_batch();
  };
  const auto to_hash = count - static_cast<std::size_t>(std::count(changed.begin(), changed.end(), 0));
  const std::size_t parts = core::parts_for(team, to_hash, kMemberBlocks);
  // Shared by the threads: the lice and flags, which nobody writes, is_another, and values_, of which each
  // writes those of its blocks.
  core::run_parts(team, parts,
                  [&](std::size_t k) { hash_blocks(k * count / parts, (k + 1) * count / parts); });
  return is_another;
}

std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link,
                         std::span<const std::uint64_t> blocks) {
  static_assert(sizeof link == 6 * sizeof(std::uint64_t));  // in the order above, without gaps
  hasher.reset();
  hasher.append(link);
  hasher.append(blocks);
  return hasher.value();
}

std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link, std::span<const Louse> lice) {
  BlockHashes blocks;
  blocks.update(lice, std::vector<std::uint8_t>(block_count(lice.size()), 1));
  return state_hash(hasher, link, blocks.values());
}

}  // namespace woodlouse::state
