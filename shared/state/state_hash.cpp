#include "shared/state/state_hash.h"

namespace woodlouse::state {

std::uint64_t state_hash(core::StableHasher& hasher, const HashLink& link, std::span<const Louse> lice) {
  hasher.reset();
  hasher.append(link.previous);
  hasher.append(link.inputs);
  hasher.append(link.tick);
  hasher.append(lice);
  hasher.append(link.generator);
  return hasher.value();
}

}  // namespace woodlouse::state
