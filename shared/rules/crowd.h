// Who of many is near whom, found by cells of the map: what it costs grows with the neighbours, not with the
// square of all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/rules/gate.h"
#include "shared/terrain/surface.h"

namespace woodlouse::rules {

class Crowd {
 public:
  struct Pair {
    std::uint32_t first = 0, second = 0;  ///< first < second
    core::Vec2 between;                   ///< from the first to the second, or to its nearest image [m]
  };

  /// distance: below which two are near each other [m], > 0. Where `images` wrap, over the seams too.
  Crowd(const terrain::Rectangle& domain, const Images& images, double distance);

  /// All pairs of these places that are near each other, by (first, second); valid until the next call.
  std::span<const Pair> pairs(std::span<const core::Vec2> places);

 private:
  struct Axis {
    double low = 0.0, per_metre = 0.0;
    std::size_t cells = 1;
    [[nodiscard]] std::uint32_t cell_of(double at) const;
  };
  [[nodiscard]] Axis axis_of(double low, double high, double most) const;
  /// Of a cell along an axis: it and those beside it, the first and how many; where it wraps, modulo cells.
  [[nodiscard]] std::pair<std::size_t, std::size_t> around(std::size_t cell, const Axis& axis) const;
  struct Cell {
    std::uint32_t column = 0, row = 0;
  };
  [[nodiscard]] std::size_t number_of(Cell cell) const { return cell.row * x_.cells + cell.column; }
  struct Place {
    core::Vec2 at;
    std::uint32_t index = 0;
  };
  void lay_cells(std::span<const core::Vec2> places);
  void sort_into_cells(std::span<const core::Vec2> places);
  void add_pairs(std::uint32_t second, core::Vec2 at, std::uint32_t begin, std::uint32_t end);
  void sort_by_first(std::size_t places);

  Images images_;
  terrain::Rectangle domain_;
  double distance_, distance2_;
  Axis x_, y_;
  std::vector<std::uint32_t> begins_;  ///< of each cell, in sorted_; and the end
  std::vector<Place> sorted_;          ///< cell by cell
  std::vector<Cell> cells_;            ///< of each place
  std::vector<Pair> found_;            ///< by second; more than there are
  std::size_t found_count_ = 0;
  std::vector<std::uint32_t> ends_;  ///< of each place's pairs as the first
  std::vector<Pair> pairs_;
};

}  // namespace woodlouse::rules
