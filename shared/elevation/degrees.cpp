#include "shared/elevation/degrees.h"

#include <algorithm>
#include <cassert>

#include "shared/core/portable_trigonometry.h"

namespace woodlouse::elevation {

core::Vec2 metres_a_degree(double latitude) {
  assert(latitude >= -90.0 && latitude <= 90.0);
  constexpr double kRadians = 3.14159265358979323846 / 180.0;
  const double phi = latitude * kRadians;
  const auto cosine = [](double angle) { return core::portable_sincos(angle).cos; };
  const double east = 111412.84 * cosine(phi) - 93.5 * cosine(3.0 * phi) + 0.118 * cosine(5.0 * phi);
  const double north =
      111132.92 - 559.82 * cosine(2.0 * phi) + 1.175 * cosine(4.0 * phi) - 0.0023 * cosine(6.0 * phi);
  return {east, north};
}

double middle_latitude(const terrain::GridFrame& frame) {
  constexpr double kMost = 89.0;  // at the poles a degree of longitude has no length
  const double middle = frame.y_origin + 0.5 * (static_cast<double>(frame.rows - 1) * frame.dy);
  return std::clamp(middle, -kMost, kMost);
}

bool looks_like_degrees(const terrain::GridFrame& frame, double steepest) {
  constexpr double kMostSpacing = 0.05;
  constexpr double kMostSlope = 100.0;
  const terrain::Rectangle d = frame.domain();
  const bool is_on_globe = d.x_min >= -180.5 && d.x_max <= 360.5 && d.y_min >= -90.5 && d.y_max <= 90.5;
  return is_on_globe && std::max(frame.dx, frame.dy) <= kMostSpacing && steepest > kMostSlope;
}

terrain::GridFrame in_metres(const terrain::GridFrame& frame) {
  const core::Vec2 metres = metres_a_degree(middle_latitude(frame));
  assert(metres.x > 0.0 && metres.y > 0.0);
  terrain::GridFrame result = frame;
  result.dx *= metres.x;
  result.dy *= metres.y;
  result.x_origin *= metres.x;
  result.y_origin *= metres.y;
  return result;
}

}  // namespace woodlouse::elevation
