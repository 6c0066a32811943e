#include "shared/state/thrust.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::state {
namespace {

constexpr double kScale = 1.0 / kThrustQuantum;
constexpr double kHalfQuantum = 0.5 * kThrustQuantum;

}  // namespace

RoundedThrust rounded_along_heading(double value) {
  assert(std::isfinite(value));
  const double rounded = std::round(std::clamp(value, -1.0, 1.0) * kScale) * kThrustQuantum;
  return {{ThrustKind::kAlongHeading, {rounded, 0.0}}, std::abs(value) >= 1.0 + kHalfQuantum};
}

RoundedThrust rounded_map_vector(core::Vec2 value) {
  assert(std::isfinite(value.x) && std::isfinite(value.y));
  const double largest = std::max({1.0, std::abs(value.x), std::abs(value.y)});
  const core::Vec2 small = (1.0 / largest) * value;  // its square can't overflow
  const double length = std::sqrt(core::dot(small, small)) * largest;
  core::Vec2 steps = kScale * value;
  if (length > 1.0) steps = (kScale * (largest / length)) * small;
  const core::Vec2 nearest{std::round(steps.x), std::round(steps.y)};
  const bool inside = core::dot(nearest, nearest) <= kScale * kScale;
  const core::Vec2 rounded = inside ? nearest : core::Vec2{std::trunc(steps.x), std::trunc(steps.y)};
  const Thrust thrust{ThrustKind::kMapVector, kThrustQuantum * rounded};
  assert(core::dot(thrust.value, thrust.value) <= 1.0);
  return {thrust, length >= 1.0 + kHalfQuantum};
}

core::Vec2 quanta_towards_zero(core::Vec2 value) {
  return {std::trunc(value.x / kThrustQuantum) * kThrustQuantum,
          std::trunc(value.y / kThrustQuantum) * kThrustQuantum};
}

}  // namespace woodlouse::state
