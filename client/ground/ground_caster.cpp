#include "client/ground/ground_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace woodlouse::client {
namespace {

/// Narrows [from, to] to where origin + t * direction lies between low and high.
void clip(double origin, double direction, double low, double high, double& from, double& to) {
  if (std::abs(direction) < 1e-12) {
    if (origin < low || origin > high) to = -1.0;
    return;
  }
  double enter = (low - origin) / direction;
  double leave = (high - origin) / direction;
  if (enter > leave) std::swap(enter, leave);
  from = std::max(from, enter);
  to = std::min(to, leave);
}

}  // namespace

GroundCaster::GroundCaster(const Relief& relief, const ObliqueCamera& camera)
    : relief_(relief), camera_(camera), domain_(relief.terrain().domain()) {
  const double range = (relief.highest() - relief.lowest()) * relief.exaggeration();
  const double width = std::min(domain_.x_max - domain_.x_min, domain_.y_max - domain_.y_min);
  top_ = relief.highest() * relief.exaggeration() + 1e-6 * range;
  bottom_ = relief.lowest() * relief.exaggeration() - 0.03 * width;
  step_ = width / 220.0;
}

std::optional<GroundHit> GroundCaster::cast(double x, double y) const {
  const Vec3 d = camera_.ray(x, y);
  const Vec3& e = camera_.eye();
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
  clip(e.x, d.x, domain_.x_min, domain_.x_max, from, to);
  clip(e.y, d.y, domain_.y_min, domain_.y_max, from, to);
  clip(e.z, d.z, bottom_, top_, from, to);
  if (from >= to) return std::nullopt;
  const Vec3 entry = e + from * d;
  if (entry.z < height(entry)) {
    const bool faces_west = entry.x - domain_.x_min < 1e-6 * (domain_.x_max - domain_.x_min);
    return GroundHit{GroundHit::Side::kEdge, entry, from, faces_west ? 1.0 : 0.7};
  }
  const double stride = step_ / length(d);
  double before = from;
  for (double way = from + stride;; way += stride) {
    const double at = std::min(way, to);
    const Vec3 p = e + at * d;
    if (p.z < ceiling(p) && p.z < height(p)) return cross(before, at, d);
    if (at >= to) return std::nullopt;
    before = at;
  }
}

GroundHit GroundCaster::cross(double above, double below, Vec3 direction) const {
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (above + below);
    const Vec3 p = camera_.eye() + middle * direction;
    (p.z < height(p) ? below : above) = middle;
  }
  return {GroundHit::Side::kTop, camera_.eye() + below * direction, below, 1.0};
}

}  // namespace woodlouse::client
