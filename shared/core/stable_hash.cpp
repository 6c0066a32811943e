#include "shared/core/stable_hash.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "shared/core/instruction_sets.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace woodlouse::core {

#if defined(__x86_64__)
void stable_hash_eight(const char* const* texts, std::size_t size, std::uint64_t* out);
#endif

struct StableHasher::State {
  XXH64_state_t xxh;
};

std::uint64_t stable_hash(std::string_view bytes) { return XXH64(bytes.data(), bytes.size(), 0); }

void stable_hashes(std::span<const char* const> texts, std::size_t size, std::uint64_t* out) {
  assert(size > 0 && size % 32 == 0);
  std::size_t done = 0;
#if defined(__x86_64__)
  constexpr std::size_t kAtOnce = 8, kWorth = 3;  // so many of them, one after the other, take as long
  static const bool is_available = has_avx512();
  while (is_available && texts.size() - done >= kWorth) {
    const std::size_t count = std::min(kAtOnce, texts.size() - done);
    std::array<const char*, kAtOnce> eight;
    std::array<std::uint64_t, kAtOnce> hashes;
    for (std::size_t i = 0; i < kAtOnce; ++i) eight[i] = texts[done + (i < count ? i : 0)];
    stable_hash_eight(eight.data(), size, hashes.data());
    std::copy_n(hashes.begin(), count, out + done);
    done += count;
  }
#endif
  for (; done < texts.size(); ++done) out[done] = stable_hash({texts[done], size});
}

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
