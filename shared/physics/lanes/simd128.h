// Two doubles in a WebAssembly vector, as those of core/lanes_avx2.h. Only for files compiled with -msimd128.
#pragma once

#include <wasm_simd128.h>

#include <cstddef>

namespace woodlouse::core {

struct Lanes2 {
  static constexpr int kCount = 2;
  static constexpr int kRow = 2;  ///< doubles that a transposition reads or writes of each lane

  /// All bits of a lane, or none.
  struct Mask {
    v128_t bits;
    friend Mask operator|(Mask a, Mask b) { return {wasm_v128_or(a.bits, b.bits)}; }
    friend Mask operator&(Mask a, Mask b) { return {wasm_v128_and(a.bits, b.bits)}; }
    friend Mask operator~(Mask a) { return {wasm_v128_not(a.bits)}; }
    [[nodiscard]] unsigned lanes() const { return wasm_i64x2_bitmask(bits); }
    static Mask of(unsigned lanes) {
      const v128_t bit = wasm_i64x2_const(1, 2);
      return {wasm_i64x2_eq(wasm_v128_and(wasm_i64x2_splat(lanes), bit), bit)};
    }
  };

  v128_t value;

  Lanes2() = default;
  Lanes2(v128_t v) : value(v) {}                    // NOLINT: lanes convert freely
  Lanes2(double v) : value(wasm_f64x2_splat(v)) {}  // NOLINT

  static Lanes2 load(const double* from) { return wasm_v128_load(from); }
  void store(double* to) const { wasm_v128_store(to, value); }

  friend Lanes2 operator+(Lanes2 a, Lanes2 b) { return wasm_f64x2_add(a.value, b.value); }
  friend Lanes2 operator-(Lanes2 a, Lanes2 b) { return wasm_f64x2_sub(a.value, b.value); }
  friend Lanes2 operator*(Lanes2 a, Lanes2 b) { return wasm_f64x2_mul(a.value, b.value); }
  friend Lanes2 operator/(Lanes2 a, Lanes2 b) { return wasm_f64x2_div(a.value, b.value); }
  friend Lanes2 operator-(Lanes2 a) { return wasm_f64x2_neg(a.value); }
  friend Mask operator>(Lanes2 a, Lanes2 b) { return {wasm_f64x2_gt(a.value, b.value)}; }
  friend Mask operator<(Lanes2 a, Lanes2 b) { return {wasm_f64x2_lt(a.value, b.value)}; }
  friend Mask operator>=(Lanes2 a, Lanes2 b) { return {wasm_f64x2_ge(a.value, b.value)}; }
  friend Mask operator<=(Lanes2 a, Lanes2 b) { return {wasm_f64x2_le(a.value, b.value)}; }
  friend Mask operator!=(Lanes2 a, Lanes2 b) { return {wasm_f64x2_ne(a.value, b.value)}; }

  /// The integer part, kept within [0, last]: the index of a cell; of NaN 0.
  [[nodiscard]] Lanes2 cell_index(int last) const {
    const v128_t positive = wasm_f64x2_pmax(wasm_f64x2_const_splat(0.0), value);  // of NaN the first
    const v128_t within = wasm_f64x2_pmin(positive, wasm_f64x2_splat(last));
    return wasm_f64x2_convert_low_i32x4(wasm_i32x4_trunc_sat_f64x2_zero(within));
  }

  /// to[l] = base + 16 * lane l, an integer below 2^31.
  void store_pointers(const double* base, const double** to) const {
    const v128_t cell = wasm_i32x4_trunc_sat_f64x2_zero(value);
    to[0] = base + 16 * static_cast<std::ptrdiff_t>(wasm_i32x4_extract_lane(cell, 0));
    to[1] = base + 16 * static_cast<std::ptrdiff_t>(wasm_i32x4_extract_lane(cell, 1));
  }

  /// out[k] = lane l's from[l][k], k = 0, 1.
  static void load_transposed(const double* const* from, Lanes2* out) {
    const v128_t a = wasm_v128_load(from[0]), b = wasm_v128_load(from[1]);
    out[0] = wasm_i64x2_shuffle(a, b, 0, 2);
    out[1] = wasm_i64x2_shuffle(a, b, 1, 3);
  }
  /// The reverse: to[l][k] = lane l of in[k].
  static void store_transposed(const Lanes2* in, double* const* to) {
    wasm_v128_store(to[0], wasm_i64x2_shuffle(in[0].value, in[1].value, 0, 2));
    wasm_v128_store(to[1], wasm_i64x2_shuffle(in[0].value, in[1].value, 1, 3));
  }
};

inline Lanes2 square_root(Lanes2 a) { return wasm_f64x2_sqrt(a.value); }
inline Lanes2 magnitude(Lanes2 a) { return wasm_f64x2_abs(a.value); }
inline Lanes2 select(Lanes2::Mask chosen, Lanes2 a, Lanes2 b) {
  return wasm_v128_bitselect(a.value, b.value, chosen.bits);
}
inline bool any(Lanes2::Mask chosen) { return wasm_v128_any_true(chosen.bits); }

}  // namespace woodlouse::core
