#include "client/ground/oblique_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace woodlouse::client {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kAzimuth = 17.0 * kDegree;  ///< how far the map is turned clockwise as seen
constexpr double kDistances = 2.4;           ///< eye to middle, in diagonals of the map
constexpr double kMargin = 0.97;             ///< of the picture that the map may fill

struct Box {
  double x_min = 1e300, x_max = -1e300, y_min = 1e300, y_max = -1e300;
  void take(const ObliqueCamera::Pixel& p) {
    x_min = std::min(x_min, p.x), x_max = std::max(x_max, p.x);
    y_min = std::min(y_min, p.y), y_max = std::max(y_max, p.y);
  }
};

}  // namespace

double camera_tilt(const Relief& relief) {
  constexpr double kPot = 58.0;
  constexpr double kHill = 35.0;
  const double t = std::clamp((relief.potness() + 0.2) / 0.4, 0.0, 1.0);
  return (kHill + (kPot - kHill) * t) * kDegree;
}

core::Vec2 oblique_up() { return {std::sin(kAzimuth), std::cos(kAzimuth)}; }

ObliqueCamera::ObliqueCamera(const Relief& relief, double tilt, double distance) {
  const terrain::Rectangle& d = relief.terrain().domain();
  const Vec3 middle{(d.x_min + d.x_max) / 2.0, (d.y_min + d.y_max) / 2.0,
                    relief.exaggeration() * (relief.lowest() + relief.highest()) / 2.0};
  forward_ = {std::sin(kAzimuth) * std::cos(tilt), std::cos(kAzimuth) * std::cos(tilt), -std::sin(tilt)};
  right_ = normalized(cross(forward_, {0.0, 0.0, 1.0}));
  up_ = cross(right_, forward_);
  eye_ = middle - distance * forward_;
}

std::optional<ObliqueCamera::Pixel> ObliqueCamera::project(Vec3 point) const {
  const Vec3 from_eye = point - eye_;
  const double depth = dot(from_eye, forward_);
  if (depth <= 0.0) return std::nullopt;
  return Pixel{middle_x_ + focal_ * dot(from_eye, right_) / depth,
               middle_y_ - focal_ * dot(from_eye, up_) / depth, depth};
}

Vec3 ObliqueCamera::ray(double x, double y) const {
  return forward_ + ((x - middle_x_) / focal_) * right_ - ((y - middle_y_) / focal_) * up_;
}

ObliqueCamera oblique_camera_for(const Relief& relief, Size size) {
  const terrain::Rectangle& d = relief.terrain().domain();
  std::vector<Vec3> probes;
  constexpr int kProbes = 48;
  for (int j = 0; j <= kProbes; ++j)
    for (int i = 0; i <= kProbes; ++i) {
      const core::Vec2 p{d.x_min + (d.x_max - d.x_min) * i / kProbes,
                         d.y_min + (d.y_max - d.y_min) * j / kProbes};
      probes.push_back({p.x, p.y, relief.sample(p).z * relief.exaggeration()});
    }
  const double width = size.columns;
  const double height = 2.0 * size.rows;
  // A map that is much wider than deep is looked at more steeply, until it has most of the picture's height.
  constexpr double kSteepest = 70.0 * kDegree, kStep = 5.0 * kDegree, kFull = 0.6;
  for (double tilt = camera_tilt(relief);; tilt = std::min(kSteepest, tilt + kStep)) {
    ObliqueCamera camera(relief, tilt, kDistances * std::hypot(d.x_max - d.x_min, d.y_max - d.y_min));
    Box box;
    for (const Vec3& probe : probes)
      if (const auto pixel = camera.project(probe)) box.take(*pixel);
    camera.focal_ = kMargin * std::min(width / (box.x_max - box.x_min), height / (box.y_max - box.y_min));
    if (camera.focal_ * (box.y_max - box.y_min) < kFull * height && tilt < kSteepest) continue;
    camera.middle_x_ = width / 2.0 - camera.focal_ * (box.x_min + box.x_max) / 2.0;
    camera.middle_y_ = height / 2.0 - camera.focal_ * (box.y_min + box.y_max) / 2.0;
    return camera;
  }
}

ObliqueCamera oblique_camera_around(const ObliqueCamera& whole, Vec3 centre, double zoom, Size size) {
  ObliqueCamera camera = whole;
  camera.focal_ *= zoom;
  camera.middle_x_ = camera.middle_y_ = 0.0;
  const auto at = camera.project(centre);
  if (!at) return whole;  // behind the eye: nothing that is played on
  camera.middle_x_ = size.columns / 2.0 - at->x;
  camera.middle_y_ = size.rows - at->y;
  return camera;
}

}  // namespace woodlouse::client
