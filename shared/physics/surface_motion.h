// The equations of motion of a mass point on z = z(x, y), in map-plane coordinates.
//
// G = (zx, zy) gradient, H Hessian, v map-plane velocity, vz = G.v, |v|3^2 = v.v + vz^2, w^2 = 1 + |G|^2:
//     s = (g + v'Hv) / w^2,   N = s w                          normal force, centripetal term included
//     a = -s G - (d + mu |N| / |v|3) v + f h / |h|3            gravity and curvature, drag, friction, thrust
// with h the unit map direction of the thrust and |h|3^2 = 1 + (G.h)^2: a push f along the tangent over h.
// Another force F in the map plane adds F - G (G.F) / w^2 to a and (G.F) / w to N: central gravity
// (central_gravity.h), a wall (walls.h). From the Lagrangian of chapter 1.1 of the document with its two
// errors put right (the factors of Cramer's rule, and v'Hv, which a local plane has not); tangential forces
// need no matrix, the mass matrix cancels. Contact is bilateral: where v'Hv < -g the bead stays on the wire
// and friction takes |N|.
//
// A thrust along the heading is a push over a direction that turns (heading.h); a negative one brakes: it
// adds to friction. At v = 0 friction and brake hold against up to mu N + brake: the stick test. |u|_M =
// sqrt(u.u + (G.u)^2) is the length in space of a tangent whose map projection is u.
//
// + - * / and sqrt only, in the order written: these are the simulation's bits. T is double, or several at
// once (core/lanes.h).
#pragma once

#include "shared/core/lanes.h"
#include "shared/core/vec2.h"
#include "shared/physics/heading.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/terrain/surface.h"

namespace woodlouse::physics {

using core::Pair;
using terrain::BasicSlopeSample;
using terrain::BasicSurfaceSample;

/// Which forces a map has; what it has not is compiled out. kAnyDrag: compiled in, and passed over where the
/// map has none, which costs nothing to be measured beside friction or thrust and halves what is compiled.
template <bool kDrag, bool kFriction, bool kThrust, bool kCentral = false, bool kAnyDrag = false>
struct Forces {
  static_assert(kDrag || !kAnyDrag);
  static constexpr bool central = kCentral;
  static constexpr bool drag = kDrag;
  static constexpr bool any_drag = kAnyDrag;
  static constexpr bool friction = kFriction;
  static constexpr bool thrust = kThrust;
  /// Some force turns with v and is singular at v = 0.
  static constexpr bool singular = kFriction || kThrust;
};

/// The same forces but for friction.
template <typename F>
using WithoutFriction = Forces<F::drag, false, F::thrust, F::central, F::any_drag>;

/// A louse's thrust made ready for the equations, once per tick.
template <typename T>
struct BasicDrive {
  Pair<T> direction{};  ///< h of a map vector, of any length
  T size2 = 1.0;        ///< h.h; 1 where there is none
  T push = 0.0;         ///< along h [m/s^2], >= 0
  T along = 0.0;        ///< along v [m/s^2]: a brake, negative; the document's thrust along v, of either sign
  Pair<T> pull{};       ///< central gravity where the louse is [m/s^2]; only with Forces::central
  bool turns = false;   ///< direction is the heading and turns (heading.h)
};
using Drive = BasicDrive<double>;

/// Below this |v|3^2 [m^2/s^2] a louse stands still: keeps the quotients below in range.
inline constexpr double kStandstill2 = 1e-200;

/// Turns a drive to a direction of length 1 (heading.h).
inline void point(Drive& drive, core::Vec2 heading) {
  drive.direction = heading;
  drive.size2 = dot(heading, heading);
}

/// After a flight: a drive that turns acts along v.
inline void follow(Drive& drive, core::Vec2 v) {
  if (drive.turns && dot(v, v) > kStandstill2) point(drive, unit(v));
}

/// After a step over h whose stages resolve nothing: a drive that turns lags behind v.
inline void lag(Drive& drive, core::Vec2 v, double h) {
  if (drive.turns) point(drive, lagging_heading(drive.direction, v, h));
}

/// The sets that the default method is compiled for where drag is not alone.
template <bool kFriction, bool kThrust>
using ForcesWithAnyDrag = Forces<true, kFriction, kThrust, false, true>;

template <typename T>
[[gnu::always_inline]] inline T squared(T a) {
  return a * a;
}

/// Of a map vector `thrust`; 1 is thrust_max.
template <typename T>
[[gnu::always_inline]] inline BasicDrive<T> drive_of_map_vector(Pair<T> thrust, double thrust_max) {
  const T size2 = dot(thrust, thrust);
  return {thrust,
          core::select(size2 > T(0.0), size2, T(1.0)),
          core::square_root(size2) * T(thrust_max),
          T(0.0),
          {},
          false};
}

/// kTurns: whether the heading is a state of its own, as with the exact equations; else what drives acts
/// along v, as the document has it.
template <bool kTurns>
Drive drive_of(const state::Louse& louse, double thrust_max) {
  if (louse.thrust_kind == state::ThrustKind::kMapVector)
    return drive_of_map_vector(louse.thrust, thrust_max);
  Drive drive;
  if (louse.thrust_kind != state::ThrustKind::kAlongHeading) return drive;
  if (kTurns && louse.thrust.x > 0.0) {
    drive.direction = louse.heading;
    drive.size2 = dot(louse.heading, louse.heading);
    drive.push = louse.thrust.x * thrust_max;
    drive.turns = true;
  } else {
    drive.along = louse.thrust.x * thrust_max;
  }
  return drive;
}

template <typename T>
[[gnu::always_inline]] inline T squared_length_in_space(const BasicSlopeSample<T>& s, Pair<T> u) {
  const T rise = s.zx * u.x + s.zy * u.y;
  return u.x * u.x + u.y * u.y + rise * rise;
}

/// v'Hv; 0 for a sample of flat ground.
template <typename Sample, typename T>
[[gnu::always_inline]] inline T curvature_along(const Sample& s, Pair<T> v) {
  if constexpr (terrain::Curved<Sample>) {
    return (s.zxx * v.x + T(2.0) * s.zxy * v.y) * v.x + s.zyy * v.y * v.y;
  } else {
    return T(0.0);
  }
}

/// Hv; 0 for a sample of flat ground.
template <typename Sample, typename T>
[[gnu::always_inline]] inline Pair<T> curvature_times(const Sample& s, Pair<T> v) {
  if constexpr (terrain::Curved<Sample>) {
    return {s.zxx * v.x + s.zxy * v.y, s.zxy * v.x + s.zyy * v.y};
  } else {
    return {T(0.0), T(0.0)};
  }
}

/// f h / |h|3.
template <typename T>
[[gnu::always_inline]] inline Pair<T> push_over_tangent(const BasicSlopeSample<T>& s, Pair<T> direction,
                                                        T push) {
  return (push / core::square_root(squared_length_in_space(s, direction))) * direction;
}

/// The part of a map-plane force that acts along the surface: F - G (G.F) / w^2.
template <typename T>
[[gnu::always_inline]] inline Pair<T> along_surface(const BasicSlopeSample<T>& s, Pair<T> force, T w2) {
  const T share = (s.zx * force.x + s.zy * force.y) / w2;
  return {force.x - share * s.zx, force.y - share * s.zy};
}

/// a at velocity v; at a standstill without friction and drive along the heading (see resting_balance).
///
/// w^2, |v|3^2 and |h|3^2 divide; their quotients come from one division by the product, that waits for no
/// root: divisions and roots are most of what a step waits for.
template <typename F, typename Sample, typename T>
[[gnu::always_inline]] inline Pair<T> acceleration(const Sample& s, Pair<T> v, const BasicDrive<T>& drive,
                                                   const state::Parameters& p) {
  using core::any, core::magnitude, core::select, core::square_root;
  const T w2 = T(1.0) + s.zx * s.zx + s.zy * s.zy;
  const T lift = T(p.gravity) + curvature_along(s, v);
  T load = lift;  // N w
  if constexpr (F::central) load = load + s.zx * drive.pull.x + s.zy * drive.pull.y;

  [[maybe_unused]] const T true_speed2 = squared_length_in_space(s, v);
  [[maybe_unused]] const auto moves = true_speed2 > T(kStandstill2);
  [[maybe_unused]] const T speed2 = select(moves, true_speed2, T(1.0));
  [[maybe_unused]] const T length2 =
      drive.size2 + squared(s.zx * drive.direction.x + s.zy * drive.direction.y);  // |h|3^2
  T w2_speed2 = w2;  // for mu |N| / |v|3 with N = load / w: one root serves both lengths
  if constexpr (F::friction) w2_speed2 = w2 * speed2;
  T inverse, inverse_w2_speed2;
  if constexpr (F::thrust) {
    inverse = T(1.0) / (w2_speed2 * length2);
    inverse_w2_speed2 = inverse * length2;
  } else {
    inverse_w2_speed2 = T(1.0) / w2_speed2;
  }
  T inverse_w2 = inverse_w2_speed2;
  if constexpr (F::friction) inverse_w2 = inverse_w2_speed2 * speed2;

  const T s_factor = load * inverse_w2;
  Pair<T> a{-s_factor * s.zx, -s_factor * s.zy};
  if constexpr (F::central) a += drive.pull;
  if constexpr (F::drag) {
    if (!F::any_drag || p.drag > 0.0) a = a - T(p.drag) * v;
  }
  if constexpr (F::singular) {
    T resistance = 0.0;
    if constexpr (F::friction)
      resistance = T(p.friction) * magnitude(load) * square_root(w2_speed2) * inverse_w2_speed2;
    if constexpr (F::thrust) {
      if (any(drive.along != T(0.0))) resistance = resistance - drive.along / square_root(speed2);
    }
    a.x = select(moves, a.x - resistance * v.x, a.x);
    a.y = select(moves, a.y - resistance * v.y, a.y);
  }
  if constexpr (F::thrust) a += (drive.push * square_root(length2) * (inverse * w2_speed2)) * drive.direction;
  return a;
}

/// The equations above, as a choice beside the document's (document/equations.h).
struct SurfaceEquations {
  static constexpr bool kExact = true;
  template <typename F, typename Sample, typename T>
  [[gnu::always_inline]] static inline Pair<T> acceleration(const Sample& s, Pair<T> v,
                                                            const BasicDrive<T>& drive,
                                                            const state::Parameters& p) {
    return physics::acceleration<F>(s, v, drive, p);
  }
};

/// The implicit half kick of VerletQ: v' = v + k a(s, v'). Gravity and curvature are a quadratic in sigma,
///     v' = c (u - k sigma G),  sigma w^2 = g + v'Hv',  u = v + k push,
///     c = (1 - k hold / |u - k sigma G|3) / (1 + k d),  at least 0
/// solved in closed form: friction and brake of `hold` take from the speed what they can in k, from rest too,
/// where v says nothing of it. What c needs of v' and sigma is taken at v, then once more. wall_load: what
/// walls add to N w (walls.h).
template <typename F, typename Sample>
core::Vec2 implicit_kick(const Sample& s, core::Vec2 v, double k, const Drive& drive,
                         const state::Parameters& p, double wall_load) {
  const double w2 = 1.0 + s.zx * s.zx + s.zy * s.zy;
  const core::Vec2 gradient{s.zx, s.zy};
  core::Vec2 u = v;
  if constexpr (F::thrust) {
    if (drive.push > 0.0) u += k * push_over_tangent(s, drive.direction, drive.push);
  }
  double extra_load = wall_load;
  if constexpr (F::central) {
    u += k * along_surface(s, drive.pull, w2);
    extra_load += s.zx * drive.pull.x + s.zy * drive.pull.y;
  }
  const double g_h_g = curvature_along(s, gradient);
  const double g_h_u = dot(curvature_times(s, gradient), u);
  const double u_h_u = curvature_along(s, u);
  core::Vec2 result = v;
  core::Vec2 kicked =
      u - (k * (p.gravity + curvature_along(s, v)) / w2) * gradient;  // what resistance is against
  for (int pass = 0; pass < (F::singular ? 2 : 1); ++pass) {
    double c = 1.0 / (1.0 + k * (F::drag ? p.drag : 0.0));
    if constexpr (F::singular) {
      double hold = 0.0;
      if constexpr (F::friction) {
        hold = p.friction * core::magnitude(p.gravity + extra_load + curvature_along(s, result)) /
               core::square_root(w2);
      }
      if constexpr (F::thrust) hold -= drive.along;
      const double length2 = squared_length_in_space(s, kicked);
      const double held = length2 > 0.0 ? k * hold / core::square_root(length2) : 0.0;
      c *= held < 1.0 ? 1.0 - held : 0.0;
    }
    const double a2 = c * c * k * k * g_h_g;
    const double a1 = w2 + 2.0 * c * c * k * g_h_u;
    const double a0 = p.gravity + c * c * u_h_u;
    const double root2 = a1 * a1 - 4.0 * a2 * a0;
    const double sigma = 2.0 * a0 / (a1 + core::square_root(root2 > 0.0 ? root2 : 0.0));
    kicked = u - (k * sigma) * gradient;
    result = c * kicked;
  }
  return result;
}

/// What acts on a louse at v = 0: the pull of gravity and thrust, and how much friction and brake can hold.
struct RestingBalance {
  core::Vec2 pull;    ///< map projection [m/s^2]
  double hold = 0.0;  ///< [m/s^2], compared with |pull|_M
};

/// wall_load(pull): what walls add to N w against that pull (walls.h).
template <typename F, typename WallLoad>
RestingBalance resting_balance(const terrain::SlopeSample& s, const Drive& drive, const state::Parameters& p,
                               const WallLoad& wall_load) {
  const double w2 = 1.0 + s.zx * s.zx + s.zy * s.zy;
  RestingBalance balance;
  balance.pull = {-p.gravity / w2 * s.zx, -p.gravity / w2 * s.zy};
  double load = p.gravity;
  if constexpr (F::central) {
    balance.pull += along_surface(s, drive.pull, w2);
    load += s.zx * drive.pull.x + s.zy * drive.pull.y;
  }
  if constexpr (F::thrust) {
    if (drive.push > 0.0) balance.pull += push_over_tangent(s, drive.direction, drive.push);
  }
  if constexpr (F::friction)
    balance.hold = p.friction * core::magnitude(load + wall_load(balance.pull)) / core::square_root(w2);
  if constexpr (F::thrust) {
    if (drive.along < 0.0) balance.hold -= drive.along;
  }
  return balance;
}

}  // namespace woodlouse::physics
