// A camera that looks down on the map from the south, a little from the west, with mild perspective.
//
// Pixels are square; (0, 0) is the upper left corner of the upper left pixel. Depth is the distance along
// the camera's axis [m]. Heights are those of the drawn world: the terrain's times Relief::exaggeration().
#pragma once

#include <optional>

#include "client/cells/cell_buffer.h"
#include "client/ground/relief.h"
#include "client/ground/vec3.h"

namespace woodlouse::client {

class ObliqueCamera {
 public:
  struct Pixel {
    double x = 0.0;
    double y = 0.0;
    double depth = 0.0;  ///< > 0
  };

  /// Where a point appears; empty behind the camera.
  [[nodiscard]] std::optional<Pixel> project(Vec3 point) const;
  /// The direction, of length 1 along the axis, in which pixel place (x, y) looks.
  [[nodiscard]] Vec3 ray(double x, double y) const;
  [[nodiscard]] const Vec3& eye() const { return eye_; }
  [[nodiscard]] const Vec3& forward() const { return forward_; }
  /// Metres a pixel covers at a depth.
  [[nodiscard]] double metres_per_pixel(double depth) const { return depth / focal_; }

  friend bool operator==(const ObliqueCamera&, const ObliqueCamera&) = default;

 private:
  friend ObliqueCamera oblique_camera_for(const Relief& relief, Size size);
  friend ObliqueCamera oblique_camera_around(const ObliqueCamera& whole, Vec3 centre, double zoom, Size size);
  ObliqueCamera(const Relief& relief, double tilt, double distance);

  Vec3 eye_;
  Vec3 forward_;
  Vec3 right_;
  Vec3 up_;
  double focal_ = 1.0;     ///< pixels
  double middle_x_ = 0.0;  ///< the axis' pixel
  double middle_y_ = 0.0;
};

/// How steeply the camera looks down [rad]: 58 degrees into a pot, whose near wall would hide it otherwise,
/// 35 at a hill, in between for what is neither.
double camera_tilt(const Relief& relief);

/// The map's direction, a unit vector, in which every one of these cameras looks.
core::Vec2 oblique_up();

/// Looks down by camera_tilt(), or more steeply, up to 70 degrees, where the map would leave much of the
/// picture's height empty: the whole map in size.columns x 2 size.rows pixels.
ObliqueCamera oblique_camera_for(const Relief& relief, Size size);

/// `zoom` times nearer than `whole`, oblique_camera_for() the same size, with `centre` in the middle.
ObliqueCamera oblique_camera_around(const ObliqueCamera& whole, Vec3 centre, double zoom, Size size);

}  // namespace woodlouse::client
