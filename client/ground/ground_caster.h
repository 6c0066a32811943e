// Where a camera's rays meet the block of earth whose upper side is the terrain.
//
// A ray is clipped to the block's box; where it enters below the surface it meets the block's side, else it
// is followed in steps of a 220th of the map's width until it is below the surface and the crossing is halved
// down. A ridge thinner than a step can be missed at its very top.
#pragma once

#include <optional>

#include "client/ground/oblique_camera.h"
#include "client/ground/relief.h"
#include "client/ground/vec3.h"

namespace woodlouse::client {

struct GroundHit {
  enum class Side { kTop, kEdge };
  Side side = Side::kTop;
  Vec3 point;               ///< heights as drawn
  double depth = 0.0;       ///< along the camera's axis [m]
  double brightness = 1.0;  ///< of an edge
};

class GroundCaster {
 public:
  /// Both outlive it.
  GroundCaster(const Relief& relief, const ObliqueCamera& camera);

  /// What the pixel place (x, y) shows; empty: the sky.
  [[nodiscard]] std::optional<GroundHit> cast(double x, double y) const;

 private:
  [[nodiscard]] double height(Vec3 p) const { return relief_.sample({p.x, p.y}).z * relief_.exaggeration(); }
  [[nodiscard]] double ceiling(Vec3 p) const { return relief_.ceiling({p.x, p.y}) * relief_.exaggeration(); }
  [[nodiscard]] GroundHit cross(double above, double below, Vec3 direction) const;

  const Relief& relief_;
  const ObliqueCamera& camera_;
  terrain::Rectangle domain_;
  double top_ = 0.0;
  double bottom_ = 0.0;
  double step_ = 0.0;  ///< [m]
};

}  // namespace woodlouse::client
