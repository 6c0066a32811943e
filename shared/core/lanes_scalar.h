// One double as a lane type (see lanes.h): the batched step for any machine.
#pragma once

#include <cstdint>

#include "shared/core/lanes.h"

namespace woodlouse::core {

struct Lanes1 {
  static constexpr int kCount = 1;
  static constexpr int kRow = 8;  ///< doubles that a transposition reads or writes of each lane

  struct Mask {
    bool bit;
    friend Mask operator|(Mask a, Mask b) { return {a.bit || b.bit}; }
    friend Mask operator&(Mask a, Mask b) { return {a.bit && b.bit}; }
    friend Mask operator~(Mask a) { return {!a.bit}; }
    [[nodiscard]] unsigned lanes() const { return bit ? 1u : 0u; }
    static Mask of(unsigned lanes) { return {(lanes & 1u) != 0}; }
  };

  double value;

  Lanes1() = default;
  Lanes1(double v) : value(v) {}  // NOLINT: lanes convert freely

  static Lanes1 load(const double* from) { return *from; }
  void store(double* to) const { *to = value; }

  friend Lanes1 operator+(Lanes1 a, Lanes1 b) { return a.value + b.value; }
  friend Lanes1 operator-(Lanes1 a, Lanes1 b) { return a.value - b.value; }
  friend Lanes1 operator*(Lanes1 a, Lanes1 b) { return a.value * b.value; }
  friend Lanes1 operator/(Lanes1 a, Lanes1 b) { return a.value / b.value; }
  friend Lanes1 operator-(Lanes1 a) { return -a.value; }
  friend Mask operator>(Lanes1 a, Lanes1 b) { return {a.value > b.value}; }
  friend Mask operator<(Lanes1 a, Lanes1 b) { return {a.value < b.value}; }
  friend Mask operator>=(Lanes1 a, Lanes1 b) { return {a.value >= b.value}; }
  friend Mask operator<=(Lanes1 a, Lanes1 b) { return {a.value <= b.value}; }
  friend Mask operator!=(Lanes1 a, Lanes1 b) { return {a.value != b.value}; }

  /// The integer part, kept within [0, last]: the index of a cell; of NaN 0.
  [[nodiscard]] Lanes1 cell_index(int last) const {
    const double positive = value > 0.0 ? value : 0.0;
    return static_cast<double>(static_cast<long long>(positive < last ? positive : last));
  }
  /// to[l] = base + 16 * lane l, an integer below 2^31.
  void store_pointers(const double* base, const double** to) const {
    *to = base + 16 * static_cast<std::ptrdiff_t>(value);
  }

  /// out[k] = lane l's from[l][k], k below kRow.
  static void load_transposed(const double* const* from, Lanes1* out) {
    for (int k = 0; k < kRow; ++k) out[k] = from[0][k];
  }
  /// The reverse: to[l][k] = lane l of in[k].
  static void store_transposed(const Lanes1* in, double* const* to) {
    for (int k = 0; k < kRow; ++k) to[0][k] = in[k].value;
  }
};

inline Lanes1 square_root(Lanes1 a) { return square_root(a.value); }
inline Lanes1 magnitude(Lanes1 a) { return magnitude(a.value); }
inline Lanes1 select(Lanes1::Mask chosen, Lanes1 a, Lanes1 b) { return select(chosen.bit, a.value, b.value); }
inline bool any(Lanes1::Mask chosen) { return chosen.bit; }

}  // namespace woodlouse::core
