// Paints over the picture of the ground what stands on it or flies over it, hidden by the hills before it.
#pragma once

#include <cstddef>
#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"
#include "client/drawing/badges.h"
#include "client/drawing/layout.h"
#include "client/drawing/louse_shape.h"
#include "client/drawing/palette.h"
#include "client/drawing/terrain_oblique_view.h"
#include "client/ground/oblique_camera.h"
#include "client/ground/relief.h"

namespace woodlouse::client {

class ObliquePainter {
 public:
  /// All outlive it; `layer` has been copied to the viewport of `cells`.
  ObliquePainter(const Relief& relief, const ObliqueCamera& camera, const ObliqueLayer& layer,
                 const Viewport& viewport, CellBuffer& cells);

  /// The point `above` metres over the ground at `p`, in the drawn world.
  [[nodiscard]] Vec3 over_ground(core::Vec2 p, double above = 0.0) const {
    return {p.x, p.y, (relief_.sample(p).z + above) * relief_.exaggeration()};
  }

  /// The i-th point of a louse's trail.
  [[nodiscard]] Vec3 of_trail(const LouseMark& louse, std::size_t i) const {
    const double flight = i < louse.trail_flights.size() ? louse.trail_flights[i] : 0.0;
    if (flight == 0.0) return over_ground(louse.trail[i]);
    return {louse.trail[i].x, louse.trail[i].y, flight * relief_.exaggeration()};
  }

  void line(Vec3 from, Vec3 to, Color color);
  /// Darkens the ground under something that flies, `half_length` metres long each way.
  void shadow(core::Vec2 under, double half_length);
  /// A louse with a rim that sets it off from any ground. Yours shows through others that stand less than its
  /// length before it; where hills hide it, its pixels shine through, every second one.
  void solid(const LouseShape& shape, double half_length, const Badge& badge, Owner owner);

 private:
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  /// `share` of `color` over what the pixel shows.
  void mix_in(int x, int y, Rgb color, double share);

  const Relief& relief_;
  const ObliqueCamera& camera_;
  Viewport viewport_;
  CellBuffer& cells_;
  int width_;
  int height_;
  const std::vector<float>& ground_;  ///< depth of each pixel
  std::vector<float> bodies_;         ///< depth of the lice painted so far
};

}  // namespace woodlouse::client
