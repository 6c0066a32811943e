// Eight doubles in an AVX-512 register (see lanes.h). Only for files compiled with -mavx512f -mavx512dq.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace woodlouse::core {

struct Lanes8 {
  static constexpr int kCount = 8;
  static constexpr int kRow = 8;  ///< doubles that a transposition reads or writes of each lane

  /// One bit a lane.
  struct Mask {
    __mmask8 bits;
    friend Mask operator|(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits | b.bits)}; }
    friend Mask operator&(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
    friend Mask operator~(Mask a) { return {static_cast<__mmask8>(~a.bits)}; }
    [[nodiscard]] unsigned lanes() const { return bits; }
    static Mask of(unsigned lanes) { return {static_cast<__mmask8>(lanes)}; }
  };

  __m512d value;

  Lanes8() = default;
  Lanes8(__m512d v) : value(v) {}                 // NOLINT: lanes convert freely
  Lanes8(double v) : value(_mm512_set1_pd(v)) {}  // NOLINT

  static Lanes8 load(const double* from) { return _mm512_loadu_pd(from); }
  void store(double* to) const { _mm512_storeu_pd(to, value); }

  friend Lanes8 operator+(Lanes8 a, Lanes8 b) { return _mm512_add_pd(a.value, b.value); }
  friend Lanes8 operator-(Lanes8 a, Lanes8 b) { return _mm512_sub_pd(a.value, b.value); }
  friend Lanes8 operator*(Lanes8 a, Lanes8 b) { return _mm512_mul_pd(a.value, b.value); }
  friend Lanes8 operator/(Lanes8 a, Lanes8 b) { return _mm512_div_pd(a.value, b.value); }
  friend Lanes8 operator-(Lanes8 a) { return _mm512_xor_pd(a.value, _mm512_set1_pd(-0.0)); }
  friend Mask operator>(Lanes8 a, Lanes8 b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_GT_OQ)}; }
  friend Mask operator<(Lanes8 a, Lanes8 b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_LT_OQ)}; }
  friend Mask operator>=(Lanes8 a, Lanes8 b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_GE_OQ)}; }
  friend Mask operator<=(Lanes8 a, Lanes8 b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_LE_OQ)}; }
  friend Mask operator!=(Lanes8 a, Lanes8 b) { return {_mm512_cmp_pd_mask(a.value, b.value, _CMP_NEQ_UQ)}; }

  /// The integer part, kept within [0, last]: the index of a cell; of NaN 0.
  [[nodiscard]] Lanes8 cell_index(int last) const {
    const __m512d positive = _mm512_max_pd(value, _mm512_setzero_pd());  // of NaN the second
    return _mm512_cvtepi32_pd(_mm512_cvttpd_epi32(_mm512_min_pd(positive, _mm512_set1_pd(last))));
  }

  /// to[l] = base + 16 * lane l, an integer below 2^31.
  void store_pointers(const double* base, const double** to) const {
    const __m512i bytes = _mm512_slli_epi64(_mm512_cvttpd_epi64(value), 7);
    _mm512_storeu_si512(to, _mm512_add_epi64(bytes, _mm512_set1_epi64(reinterpret_cast<long long>(base))));
  }

  /// out[k] = lane l's from[l][k], k = 0..7.
  static void load_transposed(const double* const* from, Lanes8* out) {
    for (int l = 0; l < 8; ++l) out[l] = load(from[l]);
    transpose(out);
  }
  /// The reverse: to[l][k] = lane l of in[k].
  static void store_transposed(const Lanes8* in, double* const* to) {
    Lanes8 rows[8];
    for (int k = 0; k < 8; ++k) rows[k] = in[k];
    transpose(rows);
    for (int l = 0; l < 8; ++l) rows[l].store(to[l]);
  }

 private:
  static void transpose(Lanes8* rows) {
    __m512d pairs[8];
    for (int l = 0; l < 8; l += 2) {
      pairs[l] = _mm512_unpacklo_pd(rows[l].value, rows[l + 1].value);      // columns 0 2 4 6
      pairs[l + 1] = _mm512_unpackhi_pd(rows[l].value, rows[l + 1].value);  // columns 1 3 5 7
    }
    for (int odd = 0; odd < 2; ++odd) {
      const __m512d low_a = _mm512_shuffle_f64x2(pairs[odd], pairs[2 + odd], 0x88);  // lanes 0-3, columns 0 4
      const __m512d low_b = _mm512_shuffle_f64x2(pairs[odd], pairs[2 + odd], 0xdd);  // columns 2 6
      const __m512d high_a = _mm512_shuffle_f64x2(pairs[4 + odd], pairs[6 + odd], 0x88);  // lanes 4-7
      const __m512d high_b = _mm512_shuffle_f64x2(pairs[4 + odd], pairs[6 + odd], 0xdd);
      rows[odd] = _mm512_shuffle_f64x2(low_a, high_a, 0x88);
      rows[4 + odd] = _mm512_shuffle_f64x2(low_a, high_a, 0xdd);
      rows[2 + odd] = _mm512_shuffle_f64x2(low_b, high_b, 0x88);
      rows[6 + odd] = _mm512_shuffle_f64x2(low_b, high_b, 0xdd);
    }
  }
};

inline Lanes8 square_root(Lanes8 a) { return _mm512_sqrt_pd(a.value); }
inline Lanes8 magnitude(Lanes8 a) { return _mm512_andnot_pd(_mm512_set1_pd(-0.0), a.value); }
inline Lanes8 select(Lanes8::Mask chosen, Lanes8 a, Lanes8 b) {
  return _mm512_mask_blend_pd(chosen.bits, b.value, a.value);
}
inline bool any(Lanes8::Mask chosen) { return chosen.bits != 0; }

}  // namespace woodlouse::core
