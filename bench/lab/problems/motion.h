// Lice for measurements, and what is asked of them: samples, energies, no walls.
#pragma once

#include <cmath>
#include <limits>
#include <variant>

#include "shared/core/vec2.h"
#include "shared/document/surface_catalogue.h"
#include "shared/physics/surface_motion.h"
#include "shared/state/louse.h"

namespace woodlouse::lab {

/// Walls that keep nobody.
inline constexpr terrain::Rectangle kNowhere{
    -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

inline terrain::SurfaceSample sample_of(const document::AnySurface& surface, core::Vec2 p) {
  return std::visit([&](const auto& s) { return s.sample(p.x, p.y); }, surface);
}

/// Kinetic plus potential energy per mass [J/kg].
inline double energy_of(const terrain::SurfaceSample& s, core::Vec2 velocity, double gravity) {
  return 0.5 * physics::squared_length_in_space(s, velocity) + gravity * s.z;
}

inline double distance(core::Vec2 a, core::Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

inline state::Louse louse_at(core::Vec2 position, core::Vec2 velocity) {
  state::Louse louse;
  louse.id = 1;
  louse.position = position;
  louse.velocity = velocity;
  return louse;
}

/// Holds a thrust in units of thrust_max; (0, 0) is none.
inline void push(state::Louse& louse, core::Vec2 thrust) {
  if (thrust == core::Vec2{}) return;
  louse.thrust = thrust;
  louse.thrust_kind = state::ThrustKind::kMapVector;
  louse.thrust_ticks = state::kHeld;
}

}  // namespace woodlouse::lab
