#include "client/play/ground_words.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "client/play/spoken_words.h"

namespace woodlouse::client {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLevel = 2.0;  // degrees

core::Vec2 gradient_at(const map::Map& map, core::Vec2 place) {
  const terrain::Rectangle& domain = map.terrain->domain();
  const auto ground = map.terrain->sample(std::clamp(place.x, domain.x_min, domain.x_max),
                                          std::clamp(place.y, domain.y_min, domain.y_max));
  return {ground.zx, ground.zy};
}

double degrees(core::Vec2 gradient) { return std::atan(std::hypot(gradient.x, gradient.y)) / kDegree; }

/// The nearest rim: how far, and to which side.
std::pair<double, core::Vec2> nearest_rim(const map::Map& map, core::Vec2 place) {
  const terrain::Rectangle& d = map.terrain->domain();
  const std::array<std::pair<double, core::Vec2>, 4> rims = {{{d.x_max - place.x, {1.0, 0.0}},
                                                              {place.x - d.x_min, {-1.0, 0.0}},
                                                              {d.y_max - place.y, {0.0, 1.0}},
                                                              {place.y - d.y_min, {0.0, -1.0}}}};
  return *std::min_element(rims.begin(), rims.end(),
                           [](const auto& a, const auto& b) { return a.first < b.first; });
}

}  // namespace

namespace words {

std::string slope_at(const map::Map& map, core::Vec2 place) {
  const core::Vec2 gradient = gradient_at(map, place);
  if (degrees(gradient) < kLevel) return "the ground is level";
  return "downhill is " + compass(-1.0 * gradient) + ", " + std::to_string(std::lround(degrees(gradient))) +
         " degrees steep";
}

std::string rim_at(const map::Map& map, state::Mode mode, core::Vec2 place, double reach) {
  if (map.definition.physics.edges == state::Edges::kWrap) return {};
  const auto [distance, side] = nearest_rim(map, place);
  if (distance > reach) return {};
  const auto& hill = map.definition.modes.hill;
  const bool falls = map.definition.physics.edges == state::Edges::kOpen ||
                     (mode == state::Mode::kHill && hill && hill->falls);
  const std::string what = falls ? "an edge to fall over " : "a wall ";
  return what + std::to_string(std::lround(std::max(0.0, distance))) + " m " + compass(side);
}

}  // namespace words

std::string GroundTeller::news(const map::Map& map, state::Mode mode, core::Vec2 place, core::Time now) {
  assert(!told_ || now >= *told_);
  const std::string rim = words::rim_at(map, mode, place, is_near_rim_ ? 1.5 * kNear : kNear);
  if (rim.empty() == is_near_rim_) {  // a warning waits for nothing
    is_near_rim_ = !is_near_rim_;
    if (is_near_rim_) return rim;
  }
  if (told_ && now - *told_ < kAtMostEvery) return {};
  const core::Vec2 gradient = gradient_at(map, place);
  const double steepness = degrees(gradient);
  const double turned = std::remainder(
      std::atan2(gradient.y, gradient.x) - std::atan2(gradient_.y, gradient_.x), 2.0 * std::numbers::pi);
  const bool is_level = steepness < kLevel;
  const bool is_other = std::abs(steepness - degrees(gradient_)) > kOtherDegrees ||
                        is_level != (degrees(gradient_) < kLevel) ||
                        (!is_level && std::abs(turned) > kOtherWay);
  if (told_ && !is_other) return {};
  told_ = now;
  gradient_ = gradient;
  return words::slope_at(map, place);
}

}  // namespace woodlouse::client
