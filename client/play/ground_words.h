// The ground under your louse for who can't see it: where it falls, and whether a wall or an edge is near.
// Pure: time is an argument.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "client/play/visible_lice.h"
#include "shared/core/clock.h"
#include "shared/map/map_definition.h"
#include "shared/state/mode.h"

namespace woodlouse::client {

namespace words {
/// "downhill is south-west, 12 degrees steep", or "the ground is level".
std::string slope_at(const map::Map& map, core::Vec2 place);
/// "a wall 2 m east", the nearest within `reach` [m]; empty where there is none. A mode may
/// have it fallen over.
std::string rim_at(const map::Map& map, state::Mode mode, core::Vec2 place, double reach);
}  // namespace words

/// What is told unasked: changes, and no flood of them.
class GroundTeller {
 public:
  static constexpr std::chrono::seconds kAtMostEvery{2};
  static constexpr double kNear = 3.0;  ///< [m] from a wall

  /// A line when there is news of the place, else empty.
  std::string news(const map::Map& map, state::Mode mode, core::Vec2 place, core::Time now);

 private:
  static constexpr double kOtherDegrees = 6.0;  ///< as much steeper or flatter is news
  static constexpr double kOtherWay = 0.6;      ///< [rad]; so is a turn of the fall by as much

  std::optional<core::Time> told_;
  core::Vec2 gradient_;  ///< told last
  bool is_near_rim_ = false;
};

}  // namespace woodlouse::client
