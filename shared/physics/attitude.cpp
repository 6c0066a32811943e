#include "shared/physics/attitude.h"

#include <cmath>

namespace woodlouse::physics {

double yaw_of(core::Vec2 heading) { return std::atan2(heading.y, heading.x); }

double pitch_of(core::Vec2 heading, core::Vec2 gradient) {
  return std::atan(-gradient.x * heading.x - gradient.y * heading.y);
}

double roll_of(core::Vec2 heading, core::Vec2 gradient, double pitch) {
  return std::atan((-gradient.x * heading.y + gradient.y * heading.x) * std::cos(pitch));
}

Attitude attitude(core::Vec2 heading, core::Vec2 gradient) {
  const double pitch = pitch_of(heading, gradient);
  return {yaw_of(heading), pitch, roll_of(heading, gradient, pitch)};
}

}  // namespace woodlouse::physics
