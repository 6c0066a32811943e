// A run of the race driven again, alone: what proves it. Lice of a race are in nobody's way, and no tick is
// like another but by what was asked for in it, so that a run is the same whenever and beside whom it is
// driven.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/map/map_definition.h"
#include "shared/rules/event.h"
#include "shared/state/ghost.h"

namespace woodlouse::match {

/// When a run led through its gates, in moments since the step began that began at the spawn: through the
/// first, which starts the clock, and so on to that one again after the last lap.
struct RunTimes {
  std::vector<rules::Moment> gates;
  /// REQUIRES gates.
  [[nodiscard]] rules::Moment time() const { return gates.back() - gates.front(); }
  friend bool operator==(const RunTimes&, const RunTimes&) = default;
};

struct Rerun {
  RunTimes times;           ///< as far as it came
  std::uint32_t ticks = 0;  ///< after which it was done, or the ghost at its end
  bool is_whole = false;    ///< all laps
};

/// Why no run of that race has such a ghost, whatever it does; empty: one may. REQUIRES a map with a race.
std::string why_no_ghost(const map::Map& map, std::uint32_t tick_hz, const state::Ghost& ghost);

/// Drives it. REQUIRES why_no_ghost() to be empty.
Rerun rerun(const map::Map& map, std::uint32_t tick_hz, const state::Ghost& ghost);

/// Where what was driven parts from what is said of it, in words: the gate and the tick; empty: nowhere.
std::string departure(const map::Map& map, const RunTimes& said, const state::Ghost& ghost,
                      const Rerun& driven);

/// All of it: why the ghost does not prove the times; empty: it does.
std::string why_not_proven(const map::Map& map, std::uint32_t tick_hz, const state::Ghost& ghost,
                           const RunTimes& said);

}  // namespace woodlouse::match
