#include "shared/physics/attitude.h"

#include <cmath>

namespace woodlouse::physics {

Attitude attitude(core::Vec2 heading, core::Vec2 gradient) {
  Attitude a;
  a.yaw = std::atan2(heading.y, heading.x);
  a.pitch = std::atan(-gradient.x * heading.x - gradient.y * heading.y);
  a.roll = std::atan((-gradient.x * heading.y + gradient.y * heading.x) * std::cos(a.pitch));
  return a;
}

}  // namespace woodlouse::physics
