// Heights that the ground stays under, cell by cell of a grid: what passes above them needs no sample of the
// surface, which is most of what a ray or a shadow asks for.
//
// A ceiling is the highest of a cell's corners and what the steepest gradient nearby, half as much again, can
// add on the way from the nearest corner. A surface that bends more within a cell (a 192nd of the map)
// passes it: each cell is asked at one more place, and where one ceiling is too low there is none anywhere.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::client {

class HeightCeiling {
 public:
  explicit HeightCeiling(const terrain::Terrain& terrain);

  /// Over the ground at a point of the domain [m]; one outside is moved into it.
  [[nodiscard]] double at(core::Vec2 p) const {
    const auto cell = [](double place) {
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(kCells - 1)));
    };
    return ceilings_[cell((p.y - domain_.y_min) * per_y_) * kCells + cell((p.x - domain_.x_min) * per_x_)];
  }

 private:
  static constexpr std::size_t kCells = 192;  ///< a side

  terrain::Rectangle domain_;
  double per_x_;  ///< cells a metre
  double per_y_;
  std::vector<double> ceilings_;
};

}  // namespace woodlouse::client
