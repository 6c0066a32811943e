// Cameras zoomed around one louse. They stand still until it nears the edge of the picture, then leap: a
// picture that scrolled with it would be written whole every frame. Where the louse is is always asked of the
// very camera that draws it, so that it is in the picture whatever the ground, the walls or a flight do.
//
// A camera leaps to where the picture is full of map (over its walls one cell is left for them), unless the
// louse would stand too near the edge there; then as far towards the louse as it takes.
#pragma once

#include <optional>

#include "client/ground/map_camera.h"
#include "client/ground/oblique_camera.h"
#include "client/ground/relief.h"
#include "client/ground/vec3.h"

namespace woodlouse::client {

class FollowCamera {
 public:
  /// relief outlives it. size: of the picture. One of another size, or of another map, begins anew.
  FollowCamera(const Relief& relief, Size size) : relief_(relief), size_(size) {}

  [[nodiscard]] Size size() const { return size_; }

  /// The camera before the whole map; made once.
  const ObliqueCamera& whole();
  /// The camera over a louse at `louse`; zoom > 0: times nearer than the whole map.
  MapCamera over(core::Vec2 louse, double zoom, Margin margin);
  /// The camera before it; `louse` is where it is drawn: heights are those of the drawn world.
  ObliqueCamera before(Vec3 louse, double zoom);

  /// How far from the picture's middle a louse may come before the camera leaps, and how near to the edge one
  /// may stand after a leap; of half the picture, each way.
  static constexpr double kLeaves = 0.72;
  static constexpr double kStands = 0.5;

 private:
  [[nodiscard]] ObliqueCamera around(Vec3 centre, double zoom);
  /// The larger of both ways: 0 in the middle of the picture, 1 at its edge.
  [[nodiscard]] double off_middle(const ObliqueCamera& camera, Vec3 louse) const;

  /// Another picture is drawn whole in any case: it begins where it is best.
  void zoom_to(double zoom) {
    if (zoom != zoom_) over_.reset(), before_.reset();
    zoom_ = zoom;
  }

  const Relief& relief_;
  Size size_;
  double zoom_ = 0.0;
  std::optional<ObliqueCamera> whole_;
  std::optional<core::Vec2> over_;
  std::optional<Vec3> before_;
};

}  // namespace woodlouse::client
