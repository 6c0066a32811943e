// Ways that hold one kind of event and nothing else: what the order of a step is measured over, event by
// event.
//
// A start counts where the way from it, at the reference's rate, holds what the event says: a wall once and
// no stop, a knot line and no wall. The lice are a room's, stepped by its own World.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::lab {

/// What a louse met on its way, ends of ticks compared; how often.
struct Met {
  int lines = 0;  ///< of knots, crossed
  int walls = 0, seams = 0, take_offs = 0, landings = 0, stops = 0;
  int core_rims = 0;  ///< of central gravity, crossed
  bool slow = false;  ///< on the ground, moving, below half a metre a second

  friend bool operator==(const Met&, const Met&) = default;
};

/// Thrusts change, where they do, so often a second; each rate is a multiple of it.
inline constexpr int kThrustsPerSecond = 15;

struct Event {
  std::string name;
  std::string ground;  ///< function; cell: a spline, no line of knots crossed; spline; plane
  std::shared_ptr<const terrain::Terrain> terrain;
  state::Parameters parameters;  ///< but for the method
  int fifteenths;                ///< how long the way is [1/15 s]
  /// A louse that may meet it.
  std::function<state::Louse(core::Random&)> start;
  std::function<bool(const Met&)> is_met;
  bool thrust_changes = false;  ///< with each fifteenth of a second, as `whims` says
};

/// A louse after the whole way.
struct Arrival {
  state::Louse louse;
  Met met;
  double sub_steps = 0.0;  ///< a tick
};

std::vector<Event> events();
/// whims: the seed of the thrusts that change. rate: a multiple of kThrustsPerSecond [Hz].
Arrival arrival(const Event& event, state::Method method, const state::Louse& start, std::uint64_t whims,
                int rate);

}  // namespace woodlouse::lab
