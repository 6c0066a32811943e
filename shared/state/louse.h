// One mass point on the terrain: everything the step reads and writes, and everything the state hash covers.
#pragma once

#include <cstdint>
#include <type_traits>

#include "shared/core/vec2.h"
#include "shared/state/thrust.h"

namespace woodlouse::state {

/// Names a louse for as long as its match lasts; never used again.
using LouseId = std::uint32_t;

enum class Phase : std::uint32_t {
  kMoving = 0,   ///< on the surface
  kResting = 1,  ///< held by friction at v = 0; not stepped until its thrust changes
  kFlying = 2,   ///< off the surface; only where the contact is unilateral
};

/// 104 bytes without padding, hashed as they lie in memory: their order is part of the state hash.
struct Louse {
  LouseId id = 0;
  Phase phase = Phase::kMoving;
  core::Vec2 position;           ///< [m], inside the domain
  core::Vec2 velocity;           ///< map-plane velocity [m/s]; vertical speed is gradient . velocity
  core::Vec2 heading{1.0, 0.0};  ///< unit vector in the map plane: velocity's direction, kept at rest
  core::Vec2 thrust;             ///< Thrust::value
  double flight_z = 0.0;         ///< height while flying [m]; 0 on the ground, where the surface tells it
  double flight_vz = 0.0;        ///< vertical speed while flying [m/s]; 0 on the ground
  double distance = 0.0;         ///< length of the path in space since the spawn [m]
  ThrustKind thrust_kind = ThrustKind::kNone;
  std::uint32_t thrust_ticks = 0;  ///< ticks the thrust still acts; kHeld: until the next one

  friend bool operator==(const Louse&, const Louse&) = default;
};
static_assert(sizeof(Louse) == 104 && std::is_trivially_copyable_v<Louse>);

/// [m/s], up; gradient: the surface's at its place, which counts on the ground.
inline double vertical_speed(const Louse& louse, core::Vec2 gradient) {
  return louse.phase == Phase::kFlying ? louse.flight_vz : core::dot(gradient, louse.velocity);
}

}  // namespace woodlouse::state
