// XXH64 over bytes, the same value everywhere (Debian libxxhash-dev, used header-only so that shared/
// links nothing). XXH64 rather than XXH3 because thirty lines of any language can recompute it.
// Numbers go in little-endian; only little-endian machines are supported.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace woodlouse::core {

static_assert(std::endian::native == std::endian::little, "the state hash hashes memory as little-endian");

/// XXH64 with seed 0 of the whole text.
std::uint64_t stable_hash(std::string_view bytes);
/// out[i] = stable_hash of the `size` bytes at texts[i]; side by side where the machine can. REQUIRES a size
/// that is a multiple of 32 and not 0.
void stable_hashes(std::span<const char* const> texts, std::size_t size, std::uint64_t* out);

/// 16 lower-case hex digits.
std::string to_hex(std::uint64_t hash);
void append_hex(std::string& out, std::uint64_t hash);

/// Streaming XXH64, seed 0.
class StableHasher {
 public:
  StableHasher();
  ~StableHasher();
  StableHasher(const StableHasher&) = delete;
  StableHasher& operator=(const StableHasher&) = delete;

  void reset();
  void append(const void* bytes, std::size_t size);

  /// Appends the object's bytes. T has no padding: that is the caller's promise.
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void append(const T& value) { append(&value, sizeof(T)); }

  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void append(std::span<const T> values) { append(values.data(), values.size_bytes()); }

  [[nodiscard]] std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace woodlouse::core
