#include "shared/core/stable_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace woodlouse::core {

struct StableHasher::State {
  XXH64_state_t xxh;
};

std::uint64_t stable_hash(std::string_view bytes) { return XXH64(bytes.data(), bytes.size(), 0); }

std::string to_hex(std::uint64_t hash) {
  std::string text;
  append_hex(text, hash);
  return text;
}

void append_hex(std::string& out, std::uint64_t hash) {
  static constexpr char kDigits[] = "0123456789abcdef";
  char text[16];
  for (std::size_t i = 16; i-- > 0; hash >>= 4) text[i] = kDigits[hash & 15];
  out.append(text, sizeof text);
}

StableHasher::StableHasher() : state_(std::make_unique<State>()) { reset(); }
StableHasher::~StableHasher() = default;
void StableHasher::reset() { XXH64_reset(&state_->xxh, 0); }
void StableHasher::append(const void* bytes, std::size_t size) {
  if (size != 0) XXH64_update(&state_->xxh, bytes, size);
}
std::uint64_t StableHasher::value() const { return XXH64_digest(&state_->xxh); }

}  // namespace woodlouse::core
