// A louse in the air: unilateral contact.
//
// Where the surface curves away so fast that it would have to pull (N < 0, that is v'Hv < -g), a louse on a
// unilateral map leaves it and flies the exact parabola
//     x = x0 + v t,   z = z0 + vz t - g t^2 / 2
// without drag and thrust, until z <= h(x, y). Landing takes the velocity's part along the surface's normal
// n = (-G, 1) / w and leaves the rest: v' = v + vn G / w in the map plane, vn = (vz - G.v) / w < 0.
// Walls reach up to the sky: there the map-plane velocity's normal part is turned and multiplied by the
// restitution. Over an open edge it stops and falls.
//
// The landing is looked for in pieces of at most a quarter cell of way (a 32nd of the tick where there are no
// cells) and located to rounding: a ridge thinner than a piece can be flown through.
#pragma once

#include <cassert>
#include <cmath>

#include "shared/core/root.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/rim.h"
#include "shared/physics/step_counters.h"
#include "shared/physics/surface_motion.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/state/step_events.h"
#include "shared/terrain/surface.h"

namespace woodlouse::physics {

/// A motion that has left the surface.
struct Flight {
  Motion over;          ///< the map-plane part
  double height = 0.0;  ///< z [m]
  double climb = 0.0;   ///< dz/dt [m/s]
};

/// Where in a step over h from `start` to `end` the normal force ends, which `at_end` is there no more: the
/// root of load(Motion) on the step's cubic, put right by what the step itself has there, as a cubic's
/// velocity is of order 3 alone. again(t): the step over t, the result where that is; h becomes t. Where it
/// is due at the start, there, with that heading.
template <typename Load, typename Again>
StepResult last_contact(const Motion& start, const Motion& end, double at_end, double& h, core::Vec2 heading,
                        const Load& load, const Again& again) {
  assert(at_end < 0.0 && h > 0.0);
  const double at_start = load(start);
  if (!(at_start > 0.0)) {
    h = 0.0;
    return {start, 0.0, 0.0, heading};
  }
  constexpr int kSteps = 3;
  const double whole = h;
  double missed = 0.0;  // by the cubic
  StepResult result;
  for (int i = 0; i < kSteps && at_start + missed > 0.0 && at_end + missed < 0.0; ++i) {
    const auto on_step = [&](double t) { return load(on_cubic(start, end, whole, t)); };
    h = core::end_of_positive(0.0, at_start + missed, whole, at_end + missed,
                              [&](double t) { return on_step(t) + missed; });
    result = again(h);
    missed = load(result.end) - on_step(h);
  }
  return result;
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
    bool left = false;     ///< at an open edge
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
    Piece piece{time, false, false, false};
    if (const double below = clearance(end); below <= 0.0) {
      double low = 0.0;
      double high = time;
      // Who has just taken off is at the ground: a moment at which it was above it, before this hop's end.
      double above = clearance(flight);
      for (int i = 0; i < 20 && !(above > 0.0); ++i) {
        low = 0.5 * (i == 0 ? time : low);
        above = clearance(after(flight, low));
      }
      if (above > 0.0) {  // else it never rose: it touches where the piece ends
        high = core::end_of_positive(low, above, high, below,
                                     [&](double t) { return clearance(after(flight, t)); });
      }
      flight = after(flight, high);
      return {high, true, false, false};
    }
    flight = end;
    const double kept = rim_.is_open() ? 1.0 : -parameters_.edge_restitution;
    if (meets_y) {
      flight.over.position.y = rim_.ahead(v).y;
      v.y = kept * v.y;
    } else if (meets_x) {
      flight.over.position.x = rim_.ahead(v).x;
      v.x = kept * v.x;
    }
    (rim_.is_open() ? piece.left : piece.bounced) = meets_x || meets_y;
    return piece;
  }

  /// All of `remaining` at one go, whatever is on the way: within the rim, and on the ground where it would
  /// be below, with no more energy than it had.
  [[nodiscard]] Flight rest_of(const Flight& flight, double remaining, bool& landed) const {
    Flight end = after(flight, remaining);
    if (!rim_.admits(end.over.position)) end.over.position = flight.over.position;  // also NaN
    end.over.position = rim_.inside(end.over.position);
    landed = !(clearance(end) > 0.0);
    return landed ? landing(flight, end) : end;
  }

  /// On the ground where a flight ends, or below where it ends: with what a landing leaves of its velocity
  /// and no more energy than it had. Where the ground lies higher than that leads, it falls back to where it
  /// began, at rest.
  [[nodiscard]] Flight landing(const Flight& start, const Flight& end) const {
    const auto s = sample_at(end.over.position);
    const double climbed = parameters_.gravity * (s.z - end.height);
    const core::Vec2 v = landed_velocity(s, end);
    const double before = dot(end.over.velocity, end.over.velocity) + end.climb * end.climb;
    const double speed2 = squared_length_in_space(s, v);
    const double most2 = before - 2.0 * climbed;
    if (speed2 <= most2) return {{end.over.position, v}, s.z, 0.0};
    if (most2 >= 0.0 && speed2 > 0.0) return {{end.over.position, std::sqrt(most2 / speed2) * v}, s.z, 0.0};
    return {{start.over.position, {}}, sample_at(start.over.position).z, 0.0};
  }

  /// The length of the way through the air [m]: Simpson's rule, order 4.
  [[nodiscard]] double way(const Flight& flight, double time) const {
    const core::Vec2 v = flight.over.velocity;
    const auto speed = [&](double t) {
      const double climb = flight.climb - parameters_.gravity * t;
      return std::sqrt(dot(v, v) + climb * climb);
    };
    return time / 6.0 * (speed(0.0) + 4.0 * speed(0.5 * time) + speed(time));
  }

 private:
  [[nodiscard]] Flight after(const Flight& f, double t) const {
    const double g = parameters_.gravity;
    return {{f.over.position + t * f.over.velocity, f.over.velocity},
            f.height + t * f.climb - 0.5 * g * t * t,
            f.climb - g * t};
  }

  [[nodiscard]] auto sample_at(core::Vec2 x) const { return surface_.sample(x.x, x.y); }
  [[nodiscard]] double clearance(const Flight& f) const { return f.height - sample_at(f.over.position).z; }

  const S& surface_;
  const state::Parameters& parameters_;
  const Rim& rim_;
  double longest_;
};

/// A louse leaves the ground at `end`.
template <terrain::Surface S>
[[gnu::always_inline]] inline void begin_flight(const S& surface, const Rim& rim, const Motion& end,
                                                state::Louse& louse, StepCounters& counters,
                                                state::StepEvents& happened) {
  const core::Vec2 place = rim.inside(end.position);
  const Flight flight = taken_off(surface.sample(place.x, place.y), end);
  louse.phase = state::Phase::kFlying;
  louse.flight_z = flight.height;
  louse.flight_vz = flight.climb;
  ++counters.flights;
  happened |= state::kTookOff;
}

/// One piece of a louse's flight, landing or seam included; at: its motion over the map.
template <terrain::Surface S>
[[gnu::always_inline]] inline typename Flyer<S>::Piece fly_on(const Flyer<S>& flyer, state::Louse& louse,
                                                              Motion& at, double remaining,
                                                              StepCounters& counters,
                                                              state::StepEvents& happened) {
  Flight flight{at, louse.flight_z, louse.flight_vz};
  const Flight start = flight;
  auto piece = flyer.fly(flight, remaining);
  if (!(piece.time < remaining)) piece.time = remaining;
  ++counters.sub_steps;
  if (piece.bounced) {
    ++counters.bounces;
    happened |= state::kMetWall;
  }
  louse.distance += flyer.way(start, piece.time);
  at = flight.over;
  if (flyer.rim().wraps() && flyer.rim().carry_home(at.position).any()) happened |= state::kCrossedSeam;
  louse.flight_z = flight.height;
  louse.flight_vz = flight.climb;
  if (piece.landed) {
    at = flyer.landing(start, {{flyer.rim().inside(at.position), at.velocity}, flight.height, flight.climb})
             .over;
    louse.phase = state::Phase::kMoving;
    louse.flight_z = louse.flight_vz = 0.0;
    happened |= state::kLanded;
  }
  return piece;
}

/// What is left of a tick in one piece (Flyer::rest_of).
template <terrain::Surface S>
void fly_out(const Flyer<S>& flyer, state::Louse& louse, Motion& at, double remaining, StepCounters& counters,
             state::StepEvents& happened) {
  const Flight start{at, louse.flight_z, louse.flight_vz};
  bool landed = false;
  const Flight end = flyer.rest_of(start, remaining, landed);
  ++counters.sub_steps;
  louse.distance += flyer.way(start, remaining);
  at = end.over;
  louse.flight_z = landed ? 0.0 : end.height;
  louse.flight_vz = landed ? 0.0 : end.climb;
  if (!landed) return;
  louse.phase = state::Phase::kMoving;
  happened |= state::kLanded;
}

/// Whether the ground no longer carries a louse at the end of a sub-step; h and result then are those of that
/// moment. Ground, Field: ground.h; again(t): the sub-step over t.
template <typename Ground, typename Field, typename Again>
bool takes_off(const Ground& ground, const Field& field, double& h, StepResult& result, const Again& again) {
  const auto& start = field.start;
  const auto load = [&](const Motion& m) {
    return ground.load(ground.site(m.position), m.velocity, field.drive, start.contact);
  };
  const double at_end = load(result.end);
  if (!(at_end < 0.0)) return false;
  result = last_contact(start.at, result.end, at_end, h, field.drive.direction, load, again);
  return true;
}

}  // namespace woodlouse::physics
