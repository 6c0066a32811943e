// When a louse drives through a gate: the line from a to b, from its right-hand side to its left.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "shared/core/vec2.h"
#include "shared/map/map_definition.h"

namespace woodlouse::rules {

/// A louse's way through one step, in the plane.
struct Way {
  core::Vec2 p0, v0, p1, v1;
  double h = 0.0;         ///< [s]
  bool is_smooth = true;  ///< the cubic through both ends is the way; else the chord, as after a bounce
};

/// Which side of the gate a place is on: below 0 before it [m^2].
inline double side_of(const map::Gate& gate, core::Vec2 p) {
  return core::cross(gate.b - gate.a, p - gate.a);
}

/// The part of the step, 0..1, after which the way is through the gate: the upper end of 24 bisections.
/// Nothing: it does not begin before the gate's line and end behind it, or goes past its ends. Half open:
/// each crossing is of exactly one step.
std::optional<double> crossing(const map::Gate& gate, const Way& way);

/// On a map whose edges wrap: places as they are seen from another one. On others everything stays.
class Images {
 public:
  /// periods: of the domain; 0 where it does not wrap.
  explicit Images(core::Vec2 periods) : periods_(periods) {}

  /// What to add to `place` for its image that is nearest to `from`. REQUIRES both in the domain.
  [[nodiscard]] core::Vec2 shift(core::Vec2 from, core::Vec2 place) const {
    if (!wraps()) return {};
    return {shift(place.x - from.x, periods_.x), shift(place.y - from.y, periods_.y)};
  }
  [[nodiscard]] core::Vec2 nearest(core::Vec2 from, core::Vec2 place) const {
    return place + shift(from, place);
  }
  /// A distance's square. All who are nearer than that to `from` see the same image of a place as the
  /// nearest, `nearest`, and each other where they are. Infinite where nothing wraps.
  [[nodiscard]] double margin2(core::Vec2 from, core::Vec2 nearest) const {
    if (!wraps()) return std::numeric_limits<double>::infinity();
    const auto square = [](double d, double period) {
      const double rest = 0.5 * period - std::max({d, -d, 0.25 * period});
      return rest * rest;
    };
    return std::min(square(nearest.x - from.x, periods_.x), square(nearest.y - from.y, periods_.y));
  }
  [[nodiscard]] bool wraps() const { return periods_.x > 0.0; }

 private:
  /// By a whole number of periods, not by a jump: nobody foretells who sees what over a seam.
  static double shift(double d, double period) {
    return static_cast<double>((d < -0.5 * period) - (d > 0.5 * period)) * period;
  }
  core::Vec2 periods_;
};

[[nodiscard]] Images images_of(const map::Map& map);

}  // namespace woodlouse::rules
