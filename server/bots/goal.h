// Where a bot wants to be: through a gate, near a point, or in a place to stay in.
#pragma once

#include <cmath>

#include "shared/core/vec2.h"
#include "shared/map/modes.h"

namespace woodlouse::server::bots {

inline double length(core::Vec2 v) { return std::hypot(v.x, v.y); }
/// The unit vector along it; 0 of what is as good as 0.
inline core::Vec2 direction(core::Vec2 v) {
  const double size = length(v);
  return size > 1e-9 ? (1.0 / size) * v : core::Vec2{};
}

class GateField;

enum class GoalKind {
  kGate,   ///< driven through from its right-hand side to its left
  kPoint,  ///< passed within its radius
  kPlace,  ///< come to and stayed in
};

struct Goal {
  GoalKind kind = GoalKind::kPoint;
  map::Gate gate;                    ///< kGate
  core::Vec2 at;                     ///< [m]; a gate's middle
  double radius = 0.0;               ///< [m]; 0 of a gate
  const GateField* field = nullptr;  ///< of a gate, where one is known
  double credit = 30.0;              ///< what it is worth to have passed it [s]

  static Goal through(const map::Gate& gate) {
    return {GoalKind::kGate, gate, 0.5 * (gate.a + gate.b), 0.0, nullptr, 30.0};
  }
  static Goal near(core::Vec2 at, double radius) { return {GoalKind::kPoint, {}, at, radius, nullptr, 30.0}; }
  static Goal stay(core::Vec2 at, double radius) { return {GoalKind::kPlace, {}, at, radius, nullptr, 30.0}; }

  /// The way through a gate: a unit vector.
  [[nodiscard]] core::Vec2 way() const {
    const core::Vec2 along = direction(gate.b - gate.a);
    return {0.0 - along.y, along.x};
  }
  [[nodiscard]] Goal moved(core::Vec2 by) const {
    Goal goal = *this;
    goal.at += by;
    goal.gate.a += by;
    goal.gate.b += by;
    return goal;
  }
};

}  // namespace woodlouse::server::bots
