#include "shared/rules/gate.h"

#include <cassert>

#include "shared/physics/nystrom.h"

namespace woodlouse::rules {
namespace {

constexpr int kBisections = 24;  // 16.7 ms / 2^24: a nanosecond

core::Vec2 at(const Way& way, double fraction) {
  if (!way.is_smooth) return way.p0 + fraction * (way.p1 - way.p0);
  return physics::on_cubic({way.p0, way.v0}, {way.p1, way.v1}, way.h, fraction * way.h).position;
}

}  // namespace

std::optional<double> crossing(const map::Gate& gate, const Way& way) {
  assert(way.h > 0.0);
  if (!(side_of(gate, way.p0) < 0.0 && side_of(gate, way.p1) >= 0.0)) return std::nullopt;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (low + high);
    (side_of(gate, at(way, middle)) >= 0.0 ? high : low) = middle;
  }
  const core::Vec2 along = gate.b - gate.a;
  const double part = core::dot(at(way, high) - gate.a, along);
  if (part < 0.0 || part > core::dot(along, along)) return std::nullopt;
  return high;
}

Images images_of(const map::Map& map) {
  if (map.definition.physics.edges != state::Edges::kWrap) return Images({0.0, 0.0});
  const terrain::Rectangle& domain = map.terrain->domain();
  return Images({domain.x_max - domain.x_min, domain.y_max - domain.y_min});
}

}  // namespace woodlouse::rules
