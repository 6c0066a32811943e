// What an action does to the steering, by how it is steered. Pure: time is an argument.
#pragma once

#include <chrono>

#include "client/controls/key_bindings.h"
#include "client/controls/steering.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

enum class SteerBy : std::uint8_t {
  kHeading,  ///< up pushes along the heading, down brakes, left and right turn
  kCompass,  ///< each pushes that way in the picture
};

struct Handling {
  SteerBy by = SteerBy::kHeading;
  core::Vec2 up{0.0, 1.0};  ///< the map's direction that goes up in the picture, a unit vector
  std::chrono::milliseconds pulse = Steering::kPulse;  ///< of a press
  bool releases_known = false;
};

/// Carries out what drives; false for actions that are somebody else's.
bool drive(Action action, const Handling& handling, Steering& steering, core::Time now);

}  // namespace woodlouse::client
