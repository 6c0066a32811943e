// Which kernel (kernel.h) steps a map's lice: by its ground and its forces. Under the rules of kernel.h.
#pragma once

#include <cstdint>
#include <span>

#include "shared/physics/batch.h"
#include "shared/physics/lanes/grounds.h"
#include "shared/physics/lanes/kernel.h"

namespace woodlouse::physics {

template <typename L, typename F, typename G>
void advance_lanes(const BatchContext& context, state::Louse* lice, std::span<const std::uint32_t> moving,
                   BatchLists& lists, StepCounters& counters) {
  LaneStepper<L, F, G>(context).advance(lice, moving, lists, counters);
}

template <typename L, typename F, typename G>
void go_on_in_lanes(const BatchContext& context, state::Louse* lice, bool at_wall, BatchLists& lists,
                    StepCounters& counters) {
  LaneStepper<L, F, G>(context).go_on(lice, at_wall, lists, counters);
}

template <typename L, typename G>
BatchStep choose_kernel(const BatchForces& forces) {
  const auto kernel = []<typename F>(F) {
    return BatchStep{L::kCount, advance_lanes<L, F, G>, go_on_in_lanes<L, F, G>};
  };
  if (forces.central) return kernel(Forces<true, true, true, true>{});
  if (forces.friction)
    return forces.thrust ? kernel(ForcesWithAnyDrag<true, true>{}) : kernel(ForcesWithAnyDrag<true, false>{});
  if (forces.thrust) return kernel(ForcesWithAnyDrag<false, true>{});
  return forces.drag ? kernel(Forces<true, false, false>{}) : kernel(Forces<false, false, false>{});
}

/// The kernel for a map's ground and forces.
template <typename L>
BatchStep choose_kernel(BatchGround ground, const BatchForces& forces) {
  return ground == BatchGround::kPlane ? choose_kernel<L, PlaneLanes<L>>(forces)
                                       : choose_kernel<L, SplineLanes<L>>(forces);
}

}  // namespace woodlouse::physics
