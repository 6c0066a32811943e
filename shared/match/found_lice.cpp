#include "shared/match/found_lice.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "shared/map/map_world.h"

namespace woodlouse::match {

FoundLice::FoundLice(const map::Map& map, double tick, state::Mode mode)
    : world_(map::make_world(map, tick, mode)) {
  assert(tick > 0.0);
}

std::span<const state::Louse> FoundLice::find(std::span<const state::Louse> before, const StepRecord& step) {
  std::vector<state::Louse> staying;
  for (const state::Louse& louse : before) {
    if (std::none_of(step.roster.begin(), step.roster.end(),
                     [&](const RosterChange& change) { return change.player == louse.id; }))
      staying.push_back(louse);
  }
  world_.restore(staying);
  for (const AppliedInput& input : step.inputs)  // of who is not among them: nothing
    world_.set_thrust(input.player, {input.kind, input.thrust}, input.ticks);
  assert(world_.lice().size() == staying.size());
  return world_.lice();
}

}  // namespace woodlouse::match
