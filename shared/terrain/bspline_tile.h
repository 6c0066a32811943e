// One tile of a tiled B-spline: the coefficients of up to 64 x 64 cells, a function of the heights and the
// tile's index alone.
//
// The tile solves the not-a-knot spline of its window, the tile and kMargin knots around it, cut off at the
// map's rim. At the rim that is the map's own end; elsewhere the window's end is wrong by the far field,
// 0.268^28 = 1e-16 of its local roughness where the tile begins. So tiles agree with the global spline, and
// neighbours with each other, to rounding.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <memory>

#include "shared/terrain/height_source.h"

namespace woodlouse::terrain {

struct BSplineTile {
  static constexpr std::size_t kCells = 64;           ///< cells a side, a power of two
  static constexpr std::size_t kStride = kCells + 3;  ///< coefficients a side: cell i takes i-1 .. i+2
  static constexpr std::size_t kMargin = 30;          ///< [knots]

  /// Of cell (i, j) within the tile: c[(j + b) * kStride + i + a], a, b = 0 .. 3, times 1/36.
  std::array<double, kStride * kStride> c;
  /// Bit j * kCells + i: cell (i, j) has a corner without data. None: no such cell.
  std::unique_ptr<std::bitset<kCells * kCells>> holes;
};

/// The tile that begins at cell (column, row). `fill_level` [m]: see fill_missing.h. REQUIRES at least 4
/// knots each way.
std::unique_ptr<BSplineTile> build_tile(const HeightSource& source, std::size_t column, std::size_t row,
                                        double fill_level);

}  // namespace woodlouse::terrain
