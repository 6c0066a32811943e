// The end of a sub-step that could not be short enough, or that lies where nobody can be: finite, within the
// rim, and with no energy from nothing.
#pragma once

#include <cmath>
#include <optional>

#include "shared/physics/central_gravity.h"
#include "shared/physics/energy_projection.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/rim.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// What a louse at rest at x would have of energy [m^2/s^2].
template <bool kCentral>
double potential(core::Vec2 x, double z, const state::Parameters& p) {
  const double height = p.gravity * z;
  return kCentral && p.central_gravity > 0.0 ? height + central_potential(x, p) : height;
}

/// `end`, slowed down to the energy that the start and the drive's push over h can have given it; where it
/// keeps its energy, brought to all of the start's. Where there is none on its way, the louse turns back
/// where it started. Start: ground.h.
template <bool kCentral, typename S, typename Start>
Motion energy_bounded(const S& surface, const Rim& rim, const state::Parameters& p, const Start& start,
                      const Drive& drive, double h, const Motion& end, bool keeps_energy) {
  const Motion back{start.at.position, -start.at.velocity};
  if (!rim.admits(end.position)) return back;  // also NaN
  const core::Vec2 place = rim.inside(end.position);
  const double speed = std::sqrt(start.speed2);
  const double push = drive.push;  // a brake gives nothing
  const double most = 0.5 * start.speed2 + potential<kCentral>(start.at.position, start.sample.z, p) +
                      push * (h * speed + 0.5 * h * h * push);
  const auto s = surface.sample(place.x, place.y);
  const double kinetic = most - potential<kCentral>(place, s.z, p);
  const double speed2 = squared_length_in_space(s, end.velocity);
  if (!(kinetic >= 0.0) || !(speed2 < 1e300)) return back;
  if (!keeps_energy && 0.5 * speed2 <= kinetic) return end;
  if (!(speed2 > kStandstill2)) return back;
  return {end.position, std::sqrt(2.0 * kinetic / speed2) * end.velocity};
}

/// `end`, put right to the energy of the start (energy_projection.h); nothing where that is not near, or lies
/// beyond a wall. Ground, Start: ground.h.
template <bool kCentral, typename Ground, typename Start>
std::optional<Motion> energy_kept(const Ground& ground, const Rim& rim, const state::Parameters& p,
                                  const Start& start, double h, const Motion& end) {
  const double energy0 = energy(start.sample, start.at.velocity, p.gravity);
  const auto s = ground.site(end.position);
  EnergyKept<double> kept;
  if constexpr (kCentral) {
    const double climbed = central_potential(end.position, p) - central_potential(start.at.position, p);
    kept = with_energy<true>(energy0, s, end, h, p.gravity, climbed, s.pull);
  } else {
    kept = with_energy(energy0, s, end, h, p.gravity);
  }
  if (!kept.near || !rim.lets_pass(kept.end.position)) return std::nullopt;
  return kept.end;
}

}  // namespace woodlouse::physics
