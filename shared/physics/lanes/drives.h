// The thrusts of lanes of lice, and the headings that turn along with them (heading.h). Under the rules of
// kernel.h.
#pragma once

#include <cstddef>

#include "shared/physics/heading.h"
#include "shared/physics/surface_motion.h"
#include "shared/state/louse.h"

namespace woodlouse::physics {

template <typename L>
struct LaneDrive {
  BasicDrive<L> force;
  unsigned turning = 0;  ///< the lanes whose thrust acts along a heading that turns; what follows is of them
  Pair<L> heading;       ///< at the step's start; loaded for every lane
  Pair<L> r1, r2, r3;    ///< its rates at the stages

  [[gnu::always_inline]] inline auto turns() const { return L::Mask::of(turning); }

  /// As drive_of(); heading must be there.
  [[gnu::always_inline]] inline void load(state::Louse* const* lice, Pair<L> thrust, double thrust_max) {
    using core::select;
    constexpr auto kCount = static_cast<std::size_t>(L::kCount);
    unsigned kinds = 0;
    for (std::size_t l = 0; l < kCount; ++l) kinds |= static_cast<unsigned>(lice[l]->thrust_kind);
    turning = 0;
    if ((kinds & static_cast<unsigned>(state::ThrustKind::kAlongHeading)) == 0) {
      force = drive_of_map_vector(thrust, thrust_max);
      return;
    }
    unsigned along = 0;
    for (std::size_t l = 0; l < kCount; ++l)
      along |= (lice[l]->thrust_kind == state::ThrustKind::kAlongHeading ? 1u : 0u) << l;
    const auto is_along = L::Mask::of(along);
    force = drive_of_map_vector(
        Pair<L>{select(is_along, L(0.0), thrust.x), select(is_along, L(0.0), thrust.y)}, thrust_max);
    const auto drives = is_along & (thrust.x > L(0.0));
    turning = drives.lanes();
    force.push = select(drives, thrust.x * L(thrust_max), force.push);
    force.along = select(is_along & ~drives, thrust.x, L(0.0)) * L(thrust_max);
    point(heading);
  }

  /// At a stage with velocity w: the rate there; then the heading of the next stage, h from the start.
  [[gnu::always_inline]] inline void turn(Pair<L>& rate, Pair<L> w, L h) {
    if (turning == 0) return;
    rate = heading_rate(force.direction, w);
    point(heading + h * rate);
  }

  /// At the last stage: the heading at the step's end becomes the direction.
  [[gnu::always_inline]] inline void finish(Pair<L> w, L h) {
    if (turning == 0) return;
    point(heading_end(heading, r1, r2, r3, heading_rate(force.direction, w), h));
  }

 private:
  [[gnu::always_inline]] inline void point(Pair<L> to) {
    const auto turned = turns();
    force.direction = {core::select(turned, to.x, force.direction.x),
                       core::select(turned, to.y, force.direction.y)};
    force.size2 = core::select(turned, dot(to, to), force.size2);
  }
};

}  // namespace woodlouse::physics
