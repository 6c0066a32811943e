// Where a big map's heights come from: a grid that is read piece by piece, when a surface needs it.
//
// Implemented by GridHeights over a grid in memory, and by whoever reads files (map/flt_grid_file.h). Called
// only when a tile is built, never per evaluation, so the indirect call costs nothing.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

/// Where the knots lie: as HeightGrid without the heights.
struct GridFrame {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double x_origin = 0.0;  ///< of knot (0, 0), the south-western one [m]
  double y_origin = 0.0;
  double dx = 1.0;  ///< > 0 [m]
  double dy = 1.0;  ///< > 0 [m]

  [[nodiscard]] Rectangle domain() const {
    return {x_origin, y_origin, x_origin + static_cast<double>(columns - 1) * dx,
            y_origin + static_cast<double>(rows - 1) * dy};
  }
};

/// Immutable heights; any thread may read.
class HeightSource {
 public:
  HeightSource() = default;
  HeightSource(const HeightSource&) = delete;
  HeightSource& operator=(const HeightSource&) = delete;
  virtual ~HeightSource() = default;

  [[nodiscard]] virtual GridFrame frame() const = 0;
  /// The heights [m] of out.size() knots of `row` (0: the southern one) from `column` on eastwards; NaN where
  /// there are no data.
  /// REQUIRES column + out.size() <= columns, row < rows.
  virtual void read(std::size_t column, std::size_t row, std::span<double> out) const = 0;
  /// Reads that failed so far; what they were to give counts as without data.
  [[nodiscard]] virtual std::uint64_t read_failures() const { return 0; }
  /// A height among those read so far that was taken for no data although nothing declares it so.
  [[nodiscard]] virtual std::optional<double> undeclared_mark() const { return std::nullopt; }
};

/// A grid in memory. Knots that are not finite count as without data.
class GridHeights final : public HeightSource {
 public:
  explicit GridHeights(HeightGrid grid) : grid_(std::move(grid)) {
    assert(grid_.heights.size() == grid_.columns * grid_.rows);
  }
  [[nodiscard]] GridFrame frame() const override {
    return {grid_.columns, grid_.rows, grid_.x_origin, grid_.y_origin, grid_.dx, grid_.dy};
  }
  void read(std::size_t column, std::size_t row, std::span<double> out) const override {
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = grid_.at(column + k, row);
  }

 private:
  HeightGrid grid_;
};

}  // namespace woodlouse::terrain
