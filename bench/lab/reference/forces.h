// What acts on a louse, for the reference: Newton's law in space with the constraint forces solved for, not
// the equations over the map that the step has. The ground pushes along its normal n, each wall along its
// own; they push so that the louse stays on what it touches:
//     V' = A + N n + R      n . V' = v'Hv / w      no part of V' along the normal of a wall that pushes
// with A gravity, the centre's pull, drag and thrust; then friction mu |N| and a brake against V.
#pragma once

#include "bench/lab/reference/ground.h"
#include "shared/state/parameters.h"
#include "shared/state/thrust.h"

namespace woodlouse::lab::reference {

struct Pair {
  Real x = 0, y = 0;
};

/// How far along the heading a louse goes on turning into its velocity [m].
inline constexpr Real kHeadingLength = 0.3L;

/// A thrust as long as it holds.
struct Thrust {
  Pair direction;      ///< of a vector, or the heading where `turns`: of length 1
  Real push = 0;       ///< along it [m/s^2]
  Real brake = 0;      ///< against V [m/s^2]
  bool turns = false;  ///< direction is the heading, a state of its own
};
/// heading: of length 1.
Thrust thrust_of(const state::Thrust& thrust, Pair heading, const state::Parameters& parameters);

/// Walls that a louse touches without velocity along their normals: -1 the low one, 1 the high one, 0 none.
struct Touched {
  int x = 0, y = 0;
};

/// V' over the map and what made it.
struct Acting {
  Pair acceleration;  ///< [m/s^2], with friction and brake where it moves
  Real normal = 0;    ///< N [m/s^2]: below 0 the ground would have to pull
  Pair wall;          ///< what walls push with, signed along x and y [m/s^2]
  Real pull = 0;      ///< |V'| in space before friction and brake [m/s^2]
};

/// At a place, with a velocity over the map, while those walls push (be it outwards); with none, what would
/// act if nothing held.
Acting acting(const Place& place, Pair position, Pair velocity, const Thrust& thrust, Touched pushing,
              const state::Parameters& parameters);

/// Which of the touched walls push: each inwards, and into none that does not push the louse is driven.
Touched pushing_of(const Place& place, Pair position, Pair velocity, const Thrust& thrust, Touched touched,
                   const state::Parameters& parameters);

/// Whether friction and brake hold who stands there.
bool holds(const Acting& at_rest, const Thrust& thrust, const state::Parameters& parameters);

/// Speed in space [m/s].
Real speed_in_space(const Place& place, Pair velocity);

/// A velocity, or a heading, after the impact on a wall whose normal is along x: ground and wall push, and
/// what comes back has `restitution` of what came.
Pair thrown_back_in_x(const Place& place, Pair u, Real restitution);
Pair thrown_back_in_y(const Place& place, Pair u, Real restitution);

}  // namespace woodlouse::lab::reference
