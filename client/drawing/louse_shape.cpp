#include "client/drawing/louse_shape.h"

#include <cmath>

namespace woodlouse::client {
namespace {

constexpr double kWidth = 0.58;   ///< of the length
constexpr double kHeight = 0.50;  ///< of the length

}  // namespace

LouseShape::LouseShape(Vec3 ground, const physics::Attitude& attitude, double half_length)
    : half_axes_{half_length, kWidth * half_length, kHeight * half_length} {
  const double cy = std::cos(attitude.yaw), sy = std::sin(attitude.yaw);
  const double cp = std::cos(attitude.pitch), sp = std::sin(attitude.pitch);
  const double cr = std::cos(attitude.roll), sr = std::sin(attitude.roll);
  // Columns of Rz(yaw) Ry(pitch) Rx(roll); a positive pitch lowers the nose, a positive roll lifts the left.
  forward_ = {cy * cp, sy * cp, -sp};
  leftward_ = {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr};
  upward_ = {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr};
  centre_ = ground + 0.9 * half_axes_.z * upward_;
}

std::optional<LouseShape::Hit> LouseShape::hit(Vec3 origin, Vec3 direction) const {
  // In axes where the ellipsoid is the unit sphere.
  const auto to_sphere = [this](Vec3 v) {
    return Vec3{dot(v, forward_) / half_axes_.x, dot(v, leftward_) / half_axes_.y,
                dot(v, upward_) / half_axes_.z};
  };
  const Vec3 o = to_sphere(origin - centre_);
  const Vec3 d = to_sphere(direction);
  const double a = dot(d, d);
  const double b = dot(o, d);
  const double discriminant = b * b - a * (dot(o, o) - 1.0);
  if (discriminant < 0.0) return std::nullopt;
  Hit hit;
  hit.way = (-b - std::sqrt(discriminant)) / a;
  if (hit.way <= 0.0) return std::nullopt;
  const Vec3 s = o + hit.way * d;
  hit.along = s.x;
  hit.normal = normalized((s.x / half_axes_.x) * forward_ + (s.y / half_axes_.y) * leftward_ +
                          (s.z / half_axes_.z) * upward_);
  return hit;
}

physics::Attitude exaggerated(const physics::Attitude& attitude, double exaggeration) {
  physics::Attitude result = attitude;
  result.pitch = std::atan(std::tan(attitude.pitch) * exaggeration);
  result.roll =
      std::atan(std::tan(attitude.roll) / std::cos(attitude.pitch) * exaggeration * std::cos(result.pitch));
  return result;
}

}  // namespace woodlouse::client
