#include "client/ground/height_ceiling.h"

#include <cmath>
#include <limits>

namespace woodlouse::client {

HeightCeiling::HeightCeiling(const terrain::Terrain& terrain)
    : domain_(terrain.domain()),
      per_x_(static_cast<double>(kCells) / (domain_.x_max - domain_.x_min)),
      per_y_(static_cast<double>(kCells) / (domain_.y_max - domain_.y_min)),
      ceilings_(kCells * kCells) {
  assert(domain_.x_min < domain_.x_max && domain_.y_min < domain_.y_max);
  constexpr std::size_t kCorners = kCells + 1;
  std::vector<double> heights, slopes;
  heights.reserve(kCorners * kCorners);
  slopes.reserve(kCorners * kCorners);
  for (std::size_t j = 0; j < kCorners; ++j)
    for (std::size_t i = 0; i < kCorners; ++i) {
      const terrain::SurfaceSample s =
          terrain.sample(std::min(domain_.x_max, domain_.x_min + static_cast<double>(i) / per_x_),
                         std::min(domain_.y_max, domain_.y_min + static_cast<double>(j) / per_y_));
      heights.push_back(s.z);
      slopes.push_back(std::hypot(s.zx, s.zy));
    }
  const double reach = 0.5 * std::hypot(1.0 / per_x_, 1.0 / per_y_);
  for (std::size_t j = 0; j < kCells; ++j)
    for (std::size_t i = 0; i < kCells; ++i) {
      const auto at = [&](const std::vector<double>& values, std::size_t x, std::size_t y) {
        return values[std::min(y, kCells) * kCorners + std::min(x, kCells)];
      };
      const double highest = std::max(
          {at(heights, i, j), at(heights, i + 1, j), at(heights, i, j + 1), at(heights, i + 1, j + 1)});
      double steepest = 0.0;  // of the cell's corners and of those around
      for (std::size_t y = j == 0 ? 0 : j - 1; y <= j + 2; ++y)
        for (std::size_t x = i == 0 ? 0 : i - 1; x <= i + 2; ++x)
          steepest = std::max(steepest, at(slopes, x, y));
      ceilings_[j * kCells + i] = highest + 1.5 * steepest * reach + 1e-9 * (1.0 + std::abs(highest));
    }
  for (std::size_t j = 0; j < kCells; ++j)
    for (std::size_t i = 0; i < kCells; ++i) {
      const core::Vec2 p{domain_.x_min + (static_cast<double>(i) + 0.41) / per_x_,
                         domain_.y_min + (static_cast<double>(j) + 0.57) / per_y_};
      if (terrain.sample(p.x, p.y).z <= ceilings_[j * kCells + i]) continue;
      std::fill(ceilings_.begin(), ceilings_.end(), std::numeric_limits<double>::infinity());
      return;
    }
}

}  // namespace woodlouse::client
