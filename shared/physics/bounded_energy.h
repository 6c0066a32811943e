// The end of a sub-step that could not be short enough, or that lies where nobody can be: finite, within the
// rim, and with no energy from nothing.
#pragma once

#include <cmath>

#include "shared/physics/nystrom.h"
#include "shared/physics/rim.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// `end`, slowed down to the energy that the start and the drive's push over h can have given it; with
/// kKeepsEnergy, where nothing but gravity acts, to all of the start's. Where there is none on its way, the
/// louse turns back where it started. Start: ground.h.
template <bool kKeepsEnergy, typename S, typename Start>
Motion energy_bounded(const S& surface, const Rim& rim, double gravity, const Start& start,
                      const Drive& drive, double h, const Motion& end) {
  const Motion back{start.at.position, -start.at.velocity};
  if (!rim.admits(end.position)) return back;  // also NaN
  const core::Vec2 place = rim.inside(end.position);
  const double speed = std::sqrt(start.speed2);
  const double push = drive.push + std::fabs(drive.along);
  const double most = 0.5 * start.speed2 + gravity * start.sample.z + push * (h * speed + 0.5 * h * h * push);
  const auto s = surface.sample(place.x, place.y);
  const double kinetic = most - gravity * s.z;
  const double speed2 = squared_length_in_space(s, end.velocity);
  if (!(kinetic >= 0.0) || !(speed2 < 1e300)) return back;
  if (!kKeepsEnergy && 0.5 * speed2 <= kinetic) return end;
  if (!(speed2 > kStandstill2)) return back;
  return {end.position, std::sqrt(2.0 * kinetic / speed2) * end.velocity};
}

}  // namespace woodlouse::physics
