// That no step makes energy. The rules of sub-steps see its start alone; so where it is not smooth
// (nystrom.h), its gain is told by its last sample, and where that is more than may be, measured. What gains
// is slowed down to what it may have; what gains far more is refused, and tried again over half its length.
// The end of a step that could not be short enough is finite, within the rim, and bounded likewise.
#pragma once

#include <cmath>

#include "shared/physics/central_gravity.h"
#include "shared/physics/energy_projection.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/rim.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// What an energy may be off by, of its terms.
inline constexpr double kEnergyRounding = 0x1p-50;

/// What a louse at rest at x would have of energy [m^2/s^2].
template <bool kCentral>
double potential(core::Vec2 x, double z, const state::Parameters& p) {
  const double height = p.gravity * z;
  return kCentral && p.central_gravity > 0.0 ? height + central_potential(x, p) : height;
}

/// The cosine in space of a push over the tangent and v, or 1 at rest.
template <typename S>
double push_along(const S& s, core::Vec2 v, core::Vec2 direction) {
  const double lengths2 = squared_length_in_space(s, v) * squared_length_in_space(s, direction);
  if (!(lengths2 > 0.0)) return 1.0;
  const double rise = (s.zx * v.x + s.zy * v.y) * (s.zx * direction.x + s.zy * direction.y);
  return (dot(v, direction) + rise) / std::sqrt(lengths2);
}

/// `end`, slowed down to the energy that the start and the drive's push over h can have given it; where it
/// keeps its energy, brought to all of the start's. Of the kinetic energies of both ends it may have gained
/// `share` (0: nothing, the push's own work apart), and what doubles round. Where there is none on its way,
/// the louse turns back where it started. Start: ground.h.
template <bool kCentral, typename S, typename Start>
Motion energy_bounded(const S& surface, const Rim& rim, const state::Parameters& p, const Start& start,
                      const Drive& drive, double h, const Motion& end, bool keeps_energy, double share) {
  const Motion back{start.at.position, -start.at.velocity};
  if (!rim.admits(end.position)) return back;  // also NaN
  const core::Vec2 place = rim.inside(end.position);
  const auto s = surface.sample(place.x, place.y);
  const double speed2 = squared_length_in_space(s, end.velocity);
  if (!(speed2 < 1e300)) return back;
  const double from = potential<kCentral>(start.at.position, start.sample.z, p);
  const double to = potential<kCentral>(place, s.z, p);
  const double climbed = to - from;
  const double speed0 = std::sqrt(start.speed2);
  // v1^2 = v0^2 - 2 climbed + push h (c0 v0 + c1 v1), c how much of the push acts along v; all of it but
  // where nothing may be gained. A brake gives nothing.
  double along0 = 1.0, along1 = 1.0;
  if (share == 0.0 && drive.push > 0.0) {
    along0 = push_along(start.sample, start.at.velocity, drive.direction);
    const core::Vec2 turned =
        drive.turns ? lagging_heading(drive.direction, end.velocity, h) : drive.direction;
    along1 = push_along(s, end.velocity, turned);
  }
  const double half0 = 0.5 * h * drive.push * along0;
  const double half1 = 0.5 * h * drive.push * along1;
  const double most2 = half1 * half1 + start.speed2 - 2.0 * climbed + 2.0 * half0 * speed0;
  const double slack =
      share * (start.speed2 + speed2) + 2.0 * kEnergyRounding * (std::fabs(from) + std::fabs(to));
  if (!(most2 > -slack)) return back;
  const double most = half1 + std::sqrt(most2 > 0.0 ? most2 : 0.0);
  if (!(most >= 0.0)) return back;  // a push against v takes more than there is
  if (!keeps_energy && speed2 <= most * most + slack) return end;
  if (!(speed2 > kStandstill2)) return back;
  return {end.position, most / std::sqrt(speed2) * end.velocity};
}

/// The length in space of a step that is no more than its two ends: between them it may have had any speed,
/// and the middle of one that was slowed down says nothing.
template <typename S, typename Start>
double way_of_ends(const S& surface, const Rim& rim, const Start& start, const Motion& end, double h) {
  const core::Vec2 place = rim.inside(end.position);
  const auto s = surface.sample(place.x, place.y);
  return 0.5 * h * (std::sqrt(start.speed2) + std::sqrt(squared_length_in_space(s, end.velocity)));
}

/// What becomes of a step.
enum class Verdict {
  kTaken,
  kDoubtful,  ///< taken once its energy is bounded
  kRefused,   ///< it makes energy as no step of this motion does, and a shorter one may not
};

/// The gain of a step over h by a sample of its end, beyond a wall too.
template <typename Ground, typename Start>
Gain measured_gain(const Ground& ground, const Rim& rim, const Start& start, const Drive& drive, double h,
                   const StepResult& result) {
  const core::Vec2 end = result.end.position;
  const core::Vec2 place = rim.wraps() ? rim.inside(end) : end;
  return ground.gain(start, ground.site(place), end, result.end, h, drive.push);
}

/// Whether a step gains far more energy than the `share` that it may, beyond what rounds in the potential.
inline bool is_gross(const Gain& gain, double share, double potential) {
  return !(gain.energy <= 16.0 * share * gain.kinetic + kEnergyRounding * std::fabs(potential));
}

/// Puts `end` right to the energy of the start (energy_projection.h); false, and `end` as it was, where that
/// is not near, or lies beyond a wall. Ground, Start: ground.h.
template <bool kCentral, typename Ground, typename Start>
bool energy_kept(const Ground& ground, const Rim& rim, const state::Parameters& p, const Start& start,
                 double h, Motion& end) {
  const double energy0 = energy(start.sample, start.at.velocity, p.gravity);
  const auto s = ground.site(rim.inside(end.position));
  EnergyKept<double> kept;
  if constexpr (kCentral) {
    const double climbed = central_potential(end.position, p) - central_potential(start.at.position, p);
    kept = with_energy<true>(energy0, s, end, h, p.gravity, climbed, s.pull);
  } else {
    kept = with_energy(energy0, s, end, h, p.gravity);
  }
  if (!kept.near || !rim.lets_pass(kept.end.position)) return false;
  end = kept.end;
  return true;
}

}  // namespace woodlouse::physics
