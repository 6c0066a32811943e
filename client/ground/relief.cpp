#include "client/ground/relief.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace woodlouse::client {
namespace {

constexpr std::size_t kProbes = 96;  ///< a side, for the statistics

/// To the light: unit, from the north-west, 38 degrees high.
constexpr core::Vec2 kLight{-0.62, 0.48};
constexpr double kLightUp = 0.62;
constexpr double kShadowed = 0.25;  ///< the share of direct light that a shadow leaves

double extent(const terrain::Rectangle& d) { return std::min(d.x_max - d.x_min, d.y_max - d.y_min); }

/// Mean height of the grid's rim less that of its middle third, over the range of heights.
double rim_above_middle(const terrain::HeightGrid& grid, double range) {
  double rim = 0.0;
  double middle = 0.0;
  double rim_count = 0.0;
  double middle_count = 0.0;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const bool is_rim = i == 0 || j == 0 || i + 1 == grid.columns || j + 1 == grid.rows;
      const bool is_middle = i > kProbes / 3 && i < 2 * kProbes / 3 && j > kProbes / 3 && j < 2 * kProbes / 3;
      if (is_rim) rim += grid.at(i, j), rim_count += 1.0;
      if (is_middle) middle += grid.at(i, j), middle_count += 1.0;
    }
  }
  return (rim / rim_count - middle / middle_count) / range;
}

}  // namespace

Relief::Relief(std::shared_ptr<const terrain::Terrain> terrain)
    : terrain_(std::move(terrain)), ceiling_(*terrain_) {
  const terrain::HeightGrid grid = terrain::sample_grid(*terrain_, kProbes, kProbes);
  std::vector<double> slopes;
  slopes.reserve(grid.heights.size());
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const terrain::SurfaceSample s = sample({grid.x_origin + static_cast<double>(i) * grid.dx,
                                               grid.y_origin + static_cast<double>(j) * grid.dy});
      slopes.push_back(std::hypot(s.zx, s.zy));
    }
  }
  std::sort(slopes.begin(), slopes.end());
  steep_ = std::max(slopes[slopes.size() * 95 / 100], 1e-9);
  heights_ = grid.heights;
  std::sort(heights_.begin(), heights_.end());
  is_flat_ = highest() - lowest() < 1e-9 * (extent(terrain_->domain()) + std::abs(highest()));
  if (is_flat_) heights_.back() = lowest() + 1e-9 * (1.0 + std::abs(lowest()));
  tile_ = round_step(extent(terrain_->domain()) / 12.0);
  const double range = highest() - lowest();
  exaggeration_ = std::clamp(0.3 * extent(terrain_->domain()) / range, 1.0, 2.0);
  potness_ = std::clamp(rim_above_middle(grid, range), -1.0, 1.0);
}

terrain::SurfaceSample Relief::sample(core::Vec2 p) const {
  const terrain::Rectangle& d = terrain_->domain();
  return terrain_->sample(std::clamp(p.x, d.x_min, d.x_max), std::clamp(p.y, d.y_min, d.y_max));
}

double Relief::tone(double z) const {
  constexpr double kMeadow = 0.4;
  if (is_flat_) return kMeadow;
  const double by_height = std::clamp((z - lowest()) / (highest() - lowest()), 0.0, 1.0);
  const auto above = std::upper_bound(heights_.begin(), heights_.end(), z);
  const double by_area = static_cast<double>(above - heights_.begin()) / static_cast<double>(heights_.size());
  return 0.45 * by_height + 0.55 * by_area;
}

double Relief::brightness(core::Vec2 p, const terrain::SurfaceSample& s) const {
  const double zx = s.zx * exaggeration_;
  const double zy = s.zy * exaggeration_;
  const double toward = (-zx * kLight.x - zy * kLight.y + kLightUp) / std::sqrt(1.0 + zx * zx + zy * zy);
  double direct = std::max(0.0, toward);
  if (direct > 0.0) direct *= kShadowed + (1.0 - kShadowed) * unshadowed(p, s.z);
  return kAmbient + (1.0 - kAmbient) * direct;
}

double Relief::extended_height(core::Vec2 p) const {
  const terrain::Rectangle& d = terrain_->domain();
  const core::Vec2 q{std::clamp(p.x, d.x_min, d.x_max), std::clamp(p.y, d.y_min, d.y_max)};
  const terrain::SurfaceSample s = terrain_->sample(q.x, q.y);
  return s.z + s.zx * (p.x - q.x) + s.zy * (p.y - q.y);
}

double Relief::unshadowed(core::Vec2 p, double z) const {
  constexpr int kSteps = 64;
  constexpr double kPenumbra = 5.0;  // 1 / how wide the light is, as a slope
  const terrain::Rectangle& d = terrain_->domain();
  const double step = std::hypot(d.x_max - d.x_min, d.y_max - d.y_min) / kSteps;
  const double top = highest() * exaggeration_;
  double least = 0.5;
  for (int i = 1; i < kSteps; ++i) {
    const double way = (i - 0.5) * step;
    const core::Vec2 q = p + way * kLight;
    const double ray = z * exaggeration_ + way * kLightUp;
    if (ray > top + way || !d.contains(q.x, q.y)) break;
    if (kPenumbra * (ray - ceiling_.at(q) * exaggeration_) >= least * way) continue;
    least = std::min(least, kPenumbra * (ray - terrain_->sample(q.x, q.y).z * exaggeration_) / way);
    if (least < -0.5) break;
  }
  return std::clamp(least + 0.5, 0.0, 1.0);
}

double Relief::tile_shade(core::Vec2 p) const {
  if (!is_flat_) return 1.0;
  const double parity = std::floor(p.x / tile_) + std::floor(p.y / tile_);
  return std::fmod(std::abs(parity), 2.0) < 0.5 ? 1.0 : 0.94;
}

double Relief::contour_interval(double distance) const { return round_step(steep_ * distance); }

double round_step(double least) {
  assert(least > 0.0);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= least) return digit * power;
  return 10.0 * power;
}

}  // namespace woodlouse::client
