// A louse's numbers as lanes: loaded and stored for several lice at once. Under the rules of kernel.h.
#pragma once

#include <cstddef>

#include "shared/state/louse.h"

namespace woodlouse::physics {

/// The fields of state::Louse from position to thrust, one register a field.
template <typename L>
struct LaneFields {
  static constexpr int kFields = 8;
  L field[kFields];  ///< x y vx vy heading_x heading_y tx ty

  [[gnu::always_inline]] inline void load(state::Louse* const* lice) {
    const double* from[L::kCount];
    for (int part = 0; part < kFields; part += L::kRow) {
      for (int l = 0; l < L::kCount; ++l) from[l] = row(*lice[l]) + part;
      L::load_transposed(from, field + part);
    }
  }
  /// Writes `count` fields of the lanes of `done`.
  [[gnu::always_inline]] inline void store(state::Louse* const* lice, unsigned done) const {
    double discarded[L::kRow];
    double* to[L::kCount];
    for (int part = 0; part < kFields; part += L::kRow) {
      for (int l = 0; l < L::kCount; ++l) to[l] = (done >> l & 1u) != 0 ? row(*lice[l]) + part : discarded;
      L::store_transposed(field + part, to);
    }
  }

 private:
  static_assert(offsetof(state::Louse, thrust) - offsetof(state::Louse, position) == 6 * sizeof(double));
  static double* row(state::Louse& louse) {
    return reinterpret_cast<double*>(reinterpret_cast<char*>(&louse) + offsetof(state::Louse, position));
  }
};

}  // namespace woodlouse::physics
