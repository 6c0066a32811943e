// The lice of a recorded game as a step finds them, for who steps it once more (step_error.h, twin.h).
#pragma once

#include <span>

#include "shared/map/map_definition.h"
#include "shared/match/match.h"
#include "shared/physics/world.h"
#include "shared/state/louse.h"

namespace woodlouse::match {

/// One thread at a time.
class FoundLice {
 public:
  /// tick: the room's [s], > 0. REQUIRES a map that has the mode.
  FoundLice(const map::Map& map, double tick, state::Mode mode);

  /// Of these lice before a step, by ascending id, those that it does not put elsewhere first, with its
  /// inputs; valid until the next call.
  std::span<const state::Louse> find(std::span<const state::Louse> before, const StepRecord& step);

 private:
  physics::World world_;
};

}  // namespace woodlouse::match
