#include "shared/rules/crumb_map.h"

#include <cassert>

namespace woodlouse::rules {

CrumbMap::CrumbMap(const terrain::Rectangle& domain, const Images& images, double distance)
    : domain_(domain),
      distance_(distance),
      per_metre_{static_cast<double>(kSide - 1) / (domain.x_max - domain.x_min),
                 static_cast<double>(kSide - 1) / (domain.y_max - domain.y_min)} {
  assert(distance > 0.0);
  if (images.wraps()) periods_ = {domain.x_max - domain.x_min, domain.y_max - domain.y_min};
}

/// cell_of() grows with the place: whoever is within the distance is in one of these cells.
void CrumbMap::add_image(std::uint32_t slot, core::Vec2 at) {
  if (at.x + distance_ < domain_.x_min || at.x - distance_ > domain_.x_max ||
      at.y + distance_ < domain_.y_min || at.y - distance_ > domain_.y_max)
    return;
  for (std::int32_t row = row_of(at.y - distance_); row <= row_of(at.y + distance_); ++row) {
    for (std::int32_t column = column_of(at.x - distance_); column <= column_of(at.x + distance_); ++column)
      cells_[static_cast<std::size_t>(row * kSide + column)] |= std::uint64_t{1} << slot;
  }
}

void CrumbMap::add(std::uint32_t slot, core::Vec2 at) {
  assert(slot < 64);
  const int images = periods_.x > 0.0 ? 1 : 0;
  for (int x = -images; x <= images; ++x) {
    for (int y = -images; y <= images; ++y) add_image(slot, {at.x + x * periods_.x, at.y + y * periods_.y});
  }
}

}  // namespace woodlouse::rules
