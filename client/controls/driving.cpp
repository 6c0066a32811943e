#include "client/controls/driving.h"

namespace woodlouse::client {
namespace {

void press(Side side, const Handling& handling, Steering& steering, core::Time now) {
  handling.releases_known ? steering.hold_to(side, now) : steering.push_to(side, now);
}

/// By the compass; false: as by the heading.
bool drive_by_compass(Action action, const Handling& handling, Steering& steering, core::Time now) {
  switch (action) {
    case Action::kPushPulse:
    case Action::kPushHold:
      return press(Side::kUp, handling, steering, now), true;
    case Action::kPushRelease:
      return steering.release_to(Side::kUp), true;
    case Action::kBrakePulse:
    case Action::kBrakeHold:
      return press(Side::kDown, handling, steering, now), true;
    case Action::kBrakeRelease:
      return steering.release_to(Side::kDown), true;
    case Action::kTurnLeft:
      return press(Side::kLeft, handling, steering, now), true;
    case Action::kTurnLeftRelease:
      return steering.release_to(Side::kLeft), true;
    case Action::kTurnRight:
      return press(Side::kRight, handling, steering, now), true;
    case Action::kTurnRightRelease:
      return steering.release_to(Side::kRight), true;
    default:
      return false;
  }
}

}  // namespace

bool drive(Action action, const Handling& handling, Steering& steering, core::Time now) {
  steering.look_along(handling.up);
  steering.set_pulse(handling.pulse);
  if (handling.by == SteerBy::kCompass && drive_by_compass(action, handling, steering, now)) return true;
  switch (action) {
    case Action::kPushPulse:
      return steering.push(now), true;
    case Action::kPushHold:
      return steering.hold_push(), true;
    case Action::kPushRelease:
      return steering.release_push(), true;
    case Action::kBrakePulse:
    case Action::kStopPulse:
      return steering.brake(now), true;
    case Action::kBrakeHold:
    case Action::kStopHold:
      return steering.hold_brake(), true;
    case Action::kBrakeRelease:
    case Action::kStopRelease:
      return steering.release_brake(), true;
    case Action::kTurnLeft:
      return steering.turn(Turn::kLeft, now), true;
    case Action::kTurnRight:
      return steering.turn(Turn::kRight, now), true;
    case Action::kTurnLeftRelease:
    case Action::kTurnRightRelease:
      return true;
    case Action::kCruise:
      return steering.toggle_cruise(), true;
    default:
      return false;
  }
}

}  // namespace woodlouse::client
