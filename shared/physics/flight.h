// A louse in the air: unilateral contact.
//
// Where the surface curves away so fast that it would have to pull (N < 0, that is v'Hv < -g), a louse on a
// unilateral map leaves it and flies the exact parabola
//     x = x0 + v t,   z = z0 + vz t - g t^2 / 2
// without drag and thrust, until z <= h(x, y). Landing takes the velocity's part along the surface's normal
// n = (-G, 1) / w and leaves the rest: v' = v + vn G / w in the map plane, vn = (vz - G.v) / w < 0.
// Walls reach up to the sky: there the map-plane velocity's normal part is turned and multiplied by the
// restitution.
//
// The landing is looked for in pieces of at most a quarter cell of way (a 32nd of the tick where there are no
// cells) and located to rounding by bisection: a ridge thinner than a piece can be flown through.
#pragma once

#include <cmath>

#include "shared/physics/nystrom.h"
#include "shared/physics/rim.h"
#include "shared/physics/step_counters.h"
#include "shared/physics/surface_motion.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/terrain/surface.h"

namespace woodlouse::physics {

/// A motion that has left the surface.
struct Flight {
  Motion over;          ///< the map-plane part
  double height = 0.0;  ///< z [m]
  double climb = 0.0;   ///< dz/dt [m/s]
};

/// g + v'Hv: the normal force's sign; below 0 a unilateral contact ends.
template <typename Sample>
double lift(const Sample& s, core::Vec2 v, const state::Parameters& p) {
  return p.gravity + curvature_along(s, v);
}

/// The flight that begins where a motion on the surface ends.
inline Flight taken_off(const terrain::SlopeSample& s, const Motion& from) {
  return {from, s.z, s.zx * from.velocity.x + s.zy * from.velocity.y};
}

/// What a landing leaves of the velocity, over the map.
inline core::Vec2 landed_velocity(const terrain::SlopeSample& s, const Flight& flight) {
  const double w2 = 1.0 + s.zx * s.zx + s.zy * s.zy;
  const core::Vec2 v = flight.over.velocity;
  const double along_normal = (flight.climb - s.zx * v.x - s.zy * v.y) / w2;  // vn / w
  return {v.x + along_normal * s.zx, v.y + along_normal * s.zy};
}

template <terrain::Surface S>
class Flyer {
 public:
  Flyer(const S& surface, const state::Parameters& parameters, const Rim& rim, double tick)
      : surface_(surface),
        parameters_(parameters),
        rim_(rim),
        longest_(std::isfinite(surface.cell()) ? tick : tick / 32.0) {}

  [[nodiscard]] const S& surface() const { return surface_; }
  [[nodiscard]] const Rim& rim() const { return rim_; }

  struct Piece {
    double time = 0.0;     ///< [s], > 0
    bool landed = false;   ///< the flight is at the ground: take landed_velocity there
    bool bounced = false;  ///< off a wall
  };

  /// Flies on for at most `remaining` seconds, up to a landing, a wall or the end of a piece.
  Piece fly(Flight& flight, double remaining) const {
    core::Vec2& v = flight.over.velocity;
    double time = remaining < longest_ ? remaining : longest_;
    const double speed = std::sqrt(dot(v, v));
    if (const double quarter = 0.25 * surface_.cell(); speed * time > quarter) time = quarter / speed;
    const core::Vec2 to_wall = rim_.flight_times(flight.over.position, v);
    const bool meets_x = to_wall.x <= time;
    if (meets_x) time = to_wall.x;
    const bool meets_y = to_wall.y <= time;
    if (meets_y) time = to_wall.y;

    Flight end = after(flight, time);
    Piece piece{time, false, false};
    if (clearance(end) <= 0.0) {
      double low = 0.0;
      double high = time;
      // Who has just taken off is at the ground: a moment at which it was above it, before this hop's end.
      bool above = clearance(flight) > 0.0;
      for (int i = 0; i < 20 && !above; ++i) {
        low = 0.5 * (i == 0 ? time : low);
        above = clearance(after(flight, low)) > 0.0;
      }
      if (above) {  // else it never rose: it touches where the piece ends
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          (clearance(after(flight, middle)) > 0.0 ? low : high) = middle;
        }
      }
      flight = after(flight, high);
      return {high, true, false};
    }
    flight = end;
    const double e = parameters_.edge_restitution;
    if (meets_y) {
      flight.over.position.y = rim_.ahead(v).y;
      v.y = -e * v.y;
    } else if (meets_x) {
      flight.over.position.x = rim_.ahead(v).x;
      v.x = -e * v.x;
    }
    piece.bounced = meets_x || meets_y;
    return piece;
  }

 private:
  [[nodiscard]] Flight after(const Flight& f, double t) const {
    const double g = parameters_.gravity;
    return {{f.over.position + t * f.over.velocity, f.over.velocity},
            f.height + t * f.climb - 0.5 * g * t * t,
            f.climb - g * t};
  }

  [[nodiscard]] double clearance(const Flight& f) const {
    return f.height - surface_.sample(f.over.position.x, f.over.position.y).z;
  }

  const S& surface_;
  const state::Parameters& parameters_;
  const Rim& rim_;
  double longest_;
};

/// A louse leaves the ground at `end`.
template <terrain::Surface S>
[[gnu::always_inline]] inline void begin_flight(const S& surface, const Motion& end, state::Louse& louse,
                                                StepCounters& counters) {
  const Flight flight = taken_off(surface.sample(end.position.x, end.position.y), end);
  louse.phase = state::Phase::kFlying;
  louse.flight_z = flight.height;
  louse.flight_vz = flight.climb;
  ++counters.flights;
}

/// One piece of a louse's flight, landing or seam included; the time it took [s], at most `remaining`. at:
/// its motion over the map.
template <terrain::Surface S>
[[gnu::always_inline]] inline double fly_on(const Flyer<S>& flyer, state::Louse& louse, Motion& at,
                                            double remaining, StepCounters& counters) {
  Flight flight{at, louse.flight_z, louse.flight_vz};
  const double speed = std::sqrt(dot(at.velocity, at.velocity) + louse.flight_vz * louse.flight_vz);
  const auto piece = flyer.fly(flight, remaining);
  ++counters.sub_steps;
  if (piece.bounced) ++counters.bounces;
  louse.distance += piece.time * speed;
  at = flight.over;
  if (flyer.rim().wraps()) flyer.rim().carry_home(at.position);
  louse.flight_z = flight.height;
  louse.flight_vz = flight.climb;
  if (piece.landed) {
    at.position = flyer.rim().inside(at.position);
    at.velocity = landed_velocity(flyer.surface().sample(at.position.x, at.position.y), flight);
    louse.phase = state::Phase::kMoving;
    louse.flight_z = louse.flight_vz = 0.0;
  }
  return piece.time < remaining ? piece.time : remaining;
}

}  // namespace woodlouse::physics
