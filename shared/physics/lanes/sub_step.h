// How long the lanes' sub-steps are: as Stepper::choose() and limit_turn() (halt.h) have it. Under the rules
// of kernel.h.
#pragma once

#include "shared/physics/heading.h"
#include "shared/physics/lanes/drives.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

template <typename L>
struct LaneSubStep {
  L h;                    ///< [s]
  typename L::Mask left;  ///< the scalar step's: capped, or at a stop
};

/// From `start` with that acceleration; s: the sample there; at most `longest` [s]. stepped: the lanes that
/// count.
template <typename F, typename L, typename Sample>
[[gnu::always_inline]] inline LaneSubStep<L> choose_sub_step(const SubStepRules& rules,
                                                             const BasicMotion<L>& start, const Sample& s,
                                                             L speed2, Pair<L> a1, const LaneDrive<L>& drive,
                                                             [[maybe_unused]] L pull, L longest,
                                                             typename L::Mask stepped) {
  using core::any, core::select, core::square_root;
  const L shortest(rules.shortest());
  const Pair<L> v = start.velocity;
  L h = longest;
  const auto asks_for_less = [&]() __attribute__((always_inline)) {
    auto less = rules.too_long(s, speed2, h);
    if constexpr (F::central) less = less | SubStepRules::swings_too_far(pull, h);
    if constexpr (F::thrust) {
      if (drive.turning != 0) less = less | (drive.turns() & heading_turns_too_far(v, a1, h));
    }
    return less;
  };
  auto too_long = asks_for_less();
  for (auto cut = too_long & (h > shortest); any(cut); cut = too_long & (h > shortest)) {
    h = select(cut, rules.halved(h), h);
    too_long = asks_for_less();
  }
  auto left = too_long;  // at the cap
  if constexpr (F::singular) {
    L a2 = squared_length_in_space(s, a1) + rules.stiffness2(drive.force.along);
    auto turns = SubStepRules::turns_too_far(a2, speed2, h);
    if constexpr (!F::friction) turns = turns & (drive.force.along < L(0.0));
    turns = turns & ~left & stepped;
    if (any(turns)) {
      const L speed = square_root(speed2);
      const L vz = s.zx * v.x + s.zy * v.y;
      const L rate = (dot(v, a1) + vz * (s.zx * a1.x + s.zy * a1.y + curvature_along(s, v))) / speed;
      a2 = select(rate > L(0.0), a2 - rate * rate, a2);
      const auto stops = [&]() __attribute__((always_inline)) { return ~(speed + h * rate > L(0.0)); };
      const auto unresolved = [&]() __attribute__((always_inline)) {
        auto strict = stops();
        if constexpr (F::thrust) {
          strict = strict | ~(drive.force.push > L(0.0)) | rules.strays_too_far(a2, speed2, h);
        } else {
          strict = strict | ~strict;
        }
        return SubStepRules::turns_too_far(a2, speed2, h) & strict;
      };
      const auto turning = turns;
      turns = turns & unresolved() & (h > shortest);
      while (any(turns)) {
        h = select(turns, rules.halved(h), h);
        turns = turns & unresolved() & (h > shortest);
      }
      left = left | (turning & (unresolved() | stops()));
    }
  }
  return {h, left};
}

}  // namespace woodlouse::physics
