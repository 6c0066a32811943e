// Which crumbs may be near a place, by cells of the map: so that most lice look at none.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "shared/core/vec2.h"
#include "shared/rules/gate.h"
#include "shared/terrain/surface.h"

namespace woodlouse::rules {

class CrumbMap {
 public:
  /// distance: within which crumbs are near [m].
  CrumbMap(const terrain::Rectangle& domain, const Images& images, double distance);

  void clear() { cells_.fill(0); }
  /// REQUIRES slot < 64.
  void add(std::uint32_t slot, core::Vec2 at);
  /// All that are near the place, as bits 1 << slot, and some that are not.
  [[nodiscard]] std::uint64_t near(core::Vec2 place) const {
    return cells_[static_cast<std::size_t>(row_of(place.y) * kSide + column_of(place.x))];
  }

 private:
  static constexpr std::int32_t kSide = 32;  ///< cells along an axis; the last is the upper edge alone

  static std::int32_t cell_of(double at, double low, double high, double per_metre) {
    return static_cast<std::int32_t>((std::min(std::max(low, at), high) - low) * per_metre);
  }
  [[nodiscard]] std::int32_t column_of(double x) const {
    return cell_of(x, domain_.x_min, domain_.x_max, per_metre_.x);
  }
  [[nodiscard]] std::int32_t row_of(double y) const {
    return cell_of(y, domain_.y_min, domain_.y_max, per_metre_.y);
  }
  void add_image(std::uint32_t slot, core::Vec2 at);

  terrain::Rectangle domain_;
  core::Vec2 periods_;  ///< 0 where the edges don't wrap
  double distance_;
  core::Vec2 per_metre_;
  std::array<std::uint64_t, kSide * kSide> cells_{};
};

}  // namespace woodlouse::rules
