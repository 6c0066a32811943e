// XXH64 of eight texts side by side, its four accumulators of two texts in each register: a machine
// multiplies one pair of 64-bit words a cycle, or eight. See CMakeLists.txt for its flags.
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace woodlouse::core {

void stable_hash_eight(const char* const* texts, std::size_t size, std::uint64_t* out);

namespace {

constexpr std::size_t kRegisters = 4;
constexpr std::size_t kStripe = 32;  // bytes that the accumulators take together

// As the format has them.
constexpr std::uint64_t kPrime1 = 0x9e3779b185ebca87u;
constexpr std::uint64_t kPrime2 = 0xc2b2ae3d27d4eb4fu;
constexpr std::uint64_t kPrime3 = 0x165667b19e3779f9u;
constexpr std::uint64_t kPrime4 = 0x85ebca77c2b2ae63u;

std::uint64_t rotated(std::uint64_t x, int bits) { return x << bits | x >> (64 - bits); }

__m512i all(std::uint64_t x) { return _mm512_set1_epi64(static_cast<long long>(x)); }

/// The accumulators of one text, merged and mixed.
std::uint64_t finished(const std::uint64_t* v, std::size_t size) {
  std::uint64_t hash = rotated(v[0], 1) + rotated(v[1], 7) + rotated(v[2], 12) + rotated(v[3], 18);
  for (std::size_t i = 0; i < 4; ++i)
    hash = (hash ^ (rotated(v[i] * kPrime2, 31) * kPrime1)) * kPrime1 + kPrime4;
  hash += size;
  hash = (hash ^ hash >> 33) * kPrime2;
  hash = (hash ^ hash >> 29) * kPrime3;
  return hash ^ hash >> 32;
}

__m256i stripe(const char* from) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)); }

}  // namespace

void stable_hash_eight(const char* const* texts, std::size_t size, std::uint64_t* out) {
  alignas(64) std::uint64_t v[8] = {kPrime1 + kPrime2, kPrime2, 0, 0 - kPrime1,
                                    kPrime1 + kPrime2, kPrime2, 0, 0 - kPrime1};
  __m512i sums[kRegisters];
  for (__m512i& sum : sums) sum = _mm512_load_si512(v);
  const __m512i prime1 = all(kPrime1), prime2 = all(kPrime2);
  for (std::size_t at = 0; at < size; at += kStripe) {
    for (std::size_t r = 0; r < kRegisters; ++r) {
      const __m512i words = _mm512_inserti64x4(_mm512_castsi256_si512(stripe(texts[2 * r] + at)),
                                               stripe(texts[2 * r + 1] + at), 1);
      const __m512i sum = _mm512_add_epi64(sums[r], _mm512_mullo_epi64(words, prime2));
      sums[r] = _mm512_mullo_epi64(_mm512_rol_epi64(sum, 31), prime1);
    }
  }
  for (std::size_t r = 0; r < kRegisters; ++r) {
    _mm512_store_si512(v, sums[r]);
    out[2 * r] = finished(v, size);
    out[2 * r + 1] = finished(v + 4, size);
  }
}

}  // namespace woodlouse::core
