// A louse as a solid: an ellipsoid that stands on the ground, turned by yaw, pitch and roll, with a white
// head.
#pragma once

#include <optional>

#include "client/ground/vec3.h"
#include "shared/physics/attitude.h"

namespace woodlouse::client {

class LouseShape {
 public:
  /// ground: where it touches; half_length [m] > 0; attitude on the ground as drawn.
  LouseShape(Vec3 ground, const physics::Attitude& attitude, double half_length);

  struct Hit {
    double way = 0.0;    ///< along the ray, in lengths of its direction
    double along = 0.0;  ///< where on the body, -1 tail .. 1 nose
    Vec3 normal;         ///< outward, unit
  };

  /// Where a ray meets it first.
  [[nodiscard]] std::optional<Hit> hit(Vec3 origin, Vec3 direction) const;

  [[nodiscard]] const Vec3& centre() const { return centre_; }
  [[nodiscard]] const Vec3& forward() const { return forward_; }  ///< unit, to the nose
  [[nodiscard]] const Vec3& upward() const { return upward_; }    ///< unit, the ground's normal

 private:
  Vec3 forward_;
  Vec3 leftward_;
  Vec3 upward_;
  Vec3 centre_;
  Vec3 half_axes_;  ///< along forward, leftward, upward [m]
};

/// The attitude on ground whose heights are drawn `exaggeration` times too high.
physics::Attitude exaggerated(const physics::Attitude& attitude, double exaggeration);

}  // namespace woodlouse::client
