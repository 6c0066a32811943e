// The shorter way between two places of a map: where the edges wrap, it may lead over a seam. For whatever is
// drawn or compared between two positions of one louse.
#pragma once

#include <optional>

#include "shared/core/vec2.h"
#include "shared/physics/rim.h"
#include "shared/state/parameters.h"
#include "shared/terrain/surface.h"

namespace woodlouse::client {

class Ways {
 public:
  /// Of a map that ends at its rim: straight ones.
  Ways() = default;
  Ways(const terrain::Rectangle& domain, state::Edges edges) {
    if (edges != state::Edges::kWrap) return;
    rim_.emplace(domain, edges);
    period_ = {domain.x_max - domain.x_min, domain.y_max - domain.y_min};
  }

  /// REQUIRES both on the map.
  [[nodiscard]] core::Vec2 way(core::Vec2 from, core::Vec2 to) const {
    const core::Vec2 straight = to - from;
    return rim_ ? core::Vec2{shorter(straight.x, period_.x), shorter(straight.y, period_.y)} : straight;
  }

  /// `to`, or its copy a period away that is nearer to `from`.
  [[nodiscard]] core::Vec2 beside(core::Vec2 from, core::Vec2 to) const {
    return rim_ ? from + way(from, to) : to;
  }

  /// The place that a way from a place leads to.
  [[nodiscard]] core::Vec2 place(core::Vec2 p) const { return rim_ ? rim_->inside(p) : p; }

 private:
  [[nodiscard]] static double shorter(double way, double period) {
    if (way > 0.5 * period) return way - period;
    return way < -0.5 * period ? way + period : way;
  }

  std::optional<physics::Rim> rim_;  ///< none: nothing wraps
  core::Vec2 period_;
};

}  // namespace woodlouse::client
