// How a louse sits on the ground: the document's Euler angles (chapter 1.3), aircraft sequence, z upwards.
//     psi   = atan2(heading_y, heading_x)                    yaw, counter-clockwise from +x
//     theta = atan(-zx cos psi - zy sin psi)                 pitch: uphill is negative
//     phi   = atan((-zx sin psi + zy cos psi) cos theta)     roll
// Only for those who look at it: libm is used and nothing of it enters the simulation.
#pragma once

#include "shared/core/vec2.h"

namespace woodlouse::physics {

struct Attitude {
  double yaw = 0.0;    ///< [rad]
  double pitch = 0.0;  ///< [rad]
  double roll = 0.0;   ///< [rad]
};

double yaw_of(core::Vec2 heading);
double pitch_of(core::Vec2 heading, core::Vec2 gradient);
double roll_of(core::Vec2 heading, core::Vec2 gradient, double pitch);
/// The angles of a louse that heads along `heading` (unit, map plane) on ground with this gradient.
Attitude attitude(core::Vec2 heading, core::Vec2 gradient);

}  // namespace woodlouse::physics
