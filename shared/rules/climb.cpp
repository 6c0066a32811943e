#include "shared/rules/climb.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace woodlouse::rules {
namespace {

using core::Vec2;

constexpr double kLookEvery = 0.25;  // [m]
// Of one way: small maps are looked at closely enough, and large ones, which come from outside, cost no more.
constexpr double kFewestLooks = 64.0, kMostLooks = 1024.0;

/// Of one way [m].
double too_steep(const map::Map& map, const Images& images, double climbable, Vec2 from, Vec2 to) {
  const double length = std::sqrt(core::dot(to - from, to - from));
  if (!(length > 0.0)) return 0.0;  // no way: nothing to climb
  const Vec2 ahead = (1.0 / length) * (to - from);
  const double looks = std::clamp(std::ceil(length / kLookEvery), kFewestLooks, kMostLooks);
  const double step = length / looks;
  double steep = 0.0;
  for (double k = 0.0; k < looks; ++k) {
    const terrain::SurfaceSample ground = ground_at(map, images, from + k * step * ahead);
    if (ground.zx * ahead.x + ground.zy * ahead.y > climbable) steep += step;
  }
  return steep;
}

}  // namespace

double climbable_slope(const state::Parameters& physics) {
  constexpr double kEverything = 100.0;
  if (!(physics.gravity > 0.0)) return kEverything;
  // g (s + mu) = T sqrt(1 + s^2), by bisection.
  double low = 0.0, high = kEverything;
  const auto climbs = [&](double slope) {
    return physics.gravity * (slope + physics.friction) <=
           physics.thrust_max * std::sqrt(1.0 + slope * slope);
  };
  if (climbs(high)) return kEverything;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (climbs(middle) ? low : high) = middle;
  }
  assert(low >= 0.0 && low < kEverything);
  return low;
}

terrain::SurfaceSample ground_at(const map::Map& map, const Images& images, Vec2 place) {
  const terrain::Rectangle& domain = map.terrain->domain();
  const auto inside = [&images](double x, double low, double high) {
    if (images.wraps()) {
      const double period = high - low;
      x -= period * std::floor((x - low) / period);
      // Rounding can put what lies a hair beside a seam on its other side.
      return x >= low && x < high ? x : low;
    }
    return std::clamp(x, low, high);
  };
  return map.terrain->sample(inside(place.x, domain.x_min, domain.x_max),
                             inside(place.y, domain.y_min, domain.y_max));
}

double length_of_run_ups(const map::Map& map) {
  assert(map.definition.modes.race);
  const std::vector<map::Gate>& gates = map.definition.modes.race->gates;
  const Images images = images_of(map);
  const double climbable = climbable_slope(map.definition.physics);
  double steep = 0.0;
  for (std::size_t k = 0; k < gates.size(); ++k) {
    const map::Gate& next = gates[(k + 1) % gates.size()];
    const Vec2 from = 0.5 * (gates[k].a + gates[k].b);
    const Vec2 to = images.nearest(from, 0.5 * (next.a + next.b));
    steep += too_steep(map, images, climbable, from, to);
  }
  assert(steep >= 0.0);
  return steep;
}

}  // namespace woodlouse::rules
