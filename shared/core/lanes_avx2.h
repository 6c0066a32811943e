// Four doubles in an AVX2 register (see lanes.h). Only for files compiled with -mavx2.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace woodlouse::core {

struct Lanes4 {
  static constexpr int kCount = 4;
  static constexpr int kRow = 4;  ///< doubles that a transposition reads or writes of each lane

  /// All bits of a lane, or none.
  struct Mask {
    __m256d bits;
    friend Mask operator|(Mask a, Mask b) { return {_mm256_or_pd(a.bits, b.bits)}; }
    friend Mask operator&(Mask a, Mask b) { return {_mm256_and_pd(a.bits, b.bits)}; }
    friend Mask operator~(Mask a) {
      return {_mm256_xor_pd(a.bits, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))};
    }
    [[nodiscard]] unsigned lanes() const { return static_cast<unsigned>(_mm256_movemask_pd(bits)); }
    static Mask of(unsigned lanes) {
      const __m256i bit = _mm256_set_epi64x(8, 4, 2, 1);
      const __m256i set = _mm256_and_si256(_mm256_set1_epi64x(lanes), bit);
      return {_mm256_castsi256_pd(_mm256_cmpeq_epi64(set, bit))};
    }
  };

  __m256d value;

  Lanes4() = default;
  Lanes4(__m256d v) : value(v) {}                 // NOLINT: lanes convert freely
  Lanes4(double v) : value(_mm256_set1_pd(v)) {}  // NOLINT

  static Lanes4 load(const double* from) { return _mm256_loadu_pd(from); }
  void store(double* to) const { _mm256_storeu_pd(to, value); }

  friend Lanes4 operator+(Lanes4 a, Lanes4 b) { return _mm256_add_pd(a.value, b.value); }
  friend Lanes4 operator-(Lanes4 a, Lanes4 b) { return _mm256_sub_pd(a.value, b.value); }
  friend Lanes4 operator*(Lanes4 a, Lanes4 b) { return _mm256_mul_pd(a.value, b.value); }
  friend Lanes4 operator/(Lanes4 a, Lanes4 b) { return _mm256_div_pd(a.value, b.value); }
  friend Lanes4 operator-(Lanes4 a) { return _mm256_xor_pd(a.value, _mm256_set1_pd(-0.0)); }
  friend Mask operator>(Lanes4 a, Lanes4 b) { return {_mm256_cmp_pd(a.value, b.value, _CMP_GT_OQ)}; }
  friend Mask operator<(Lanes4 a, Lanes4 b) { return {_mm256_cmp_pd(a.value, b.value, _CMP_LT_OQ)}; }
  friend Mask operator>=(Lanes4 a, Lanes4 b) { return {_mm256_cmp_pd(a.value, b.value, _CMP_GE_OQ)}; }
  friend Mask operator<=(Lanes4 a, Lanes4 b) { return {_mm256_cmp_pd(a.value, b.value, _CMP_LE_OQ)}; }
  friend Mask operator!=(Lanes4 a, Lanes4 b) { return {_mm256_cmp_pd(a.value, b.value, _CMP_NEQ_UQ)}; }

  /// The integer part, kept within [0, last]: the index of a cell; of NaN 0.
  [[nodiscard]] Lanes4 cell_index(int last) const {
    const __m256d positive = _mm256_max_pd(value, _mm256_setzero_pd());  // of NaN the second
    return _mm256_cvtepi32_pd(_mm256_cvttpd_epi32(_mm256_min_pd(positive, _mm256_set1_pd(last))));
  }

  /// to[l] = base + 16 * lane l, an integer below 2^31.
  void store_pointers(const double* base, const double** to) const {
    const __m256i bytes = _mm256_slli_epi64(_mm256_cvtepi32_epi64(_mm256_cvttpd_epi32(value)), 7);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_add_epi64(bytes, _mm256_set1_epi64x(reinterpret_cast<long long>(base))));
  }

  /// out[k] = lane l's from[l][k], k = 0..3.
  static void load_transposed(const double* const* from, Lanes4* out) {
    for (int l = 0; l < 4; ++l) out[l] = load(from[l]);
    transpose(out);
  }
  /// The reverse: to[l][k] = lane l of in[k].
  static void store_transposed(const Lanes4* in, double* const* to) {
    Lanes4 rows[4] = {in[0], in[1], in[2], in[3]};
    transpose(rows);
    for (int l = 0; l < 4; ++l) rows[l].store(to[l]);
  }

 private:
  static void transpose(Lanes4* rows) {
    const __m256d even_a = _mm256_unpacklo_pd(rows[0].value, rows[1].value);
    const __m256d odd_a = _mm256_unpackhi_pd(rows[0].value, rows[1].value);
    const __m256d even_b = _mm256_unpacklo_pd(rows[2].value, rows[3].value);
    const __m256d odd_b = _mm256_unpackhi_pd(rows[2].value, rows[3].value);
    rows[0] = _mm256_permute2f128_pd(even_a, even_b, 0x20);
    rows[1] = _mm256_permute2f128_pd(odd_a, odd_b, 0x20);
    rows[2] = _mm256_permute2f128_pd(even_a, even_b, 0x31);
    rows[3] = _mm256_permute2f128_pd(odd_a, odd_b, 0x31);
  }
};

inline Lanes4 square_root(Lanes4 a) { return _mm256_sqrt_pd(a.value); }
inline Lanes4 magnitude(Lanes4 a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a.value); }
inline Lanes4 select(Lanes4::Mask chosen, Lanes4 a, Lanes4 b) {
  return _mm256_blendv_pd(b.value, a.value, chosen.bits);
}
inline bool any(Lanes4::Mask chosen) { return chosen.lanes() != 0; }

}  // namespace woodlouse::core
