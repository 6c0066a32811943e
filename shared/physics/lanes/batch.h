// What a batch of lanes hands from stage to stage. Under the rules of kernel.h.
#pragma once

#include "shared/physics/central_gravity.h"
#include "shared/physics/lanes/drives.h"
#include "shared/physics/lanes/walls.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/surface_motion.h"

namespace woodlouse::physics {

/// L: the lanes; F: the Forces the map has; G: its ground (grounds.h).
template <typename L, typename F, typename G>
struct LaneBatch {
  /// Whether a map with these forces may conserve energy.
  static constexpr bool kMayKeepEnergy =
      F::central || (!F::friction && (!F::drag || F::any_drag) && terrain::Curved<typename G::Sample>);

  BasicMotion<L> start;
  LaneDrive<L> drive;
  typename G::Place place;
  typename G::Sample s;
  Pair<L> w;  ///< velocity of the stage
  Pair<L> a1, a2, a3, a4, thrust;
  L h, way, remaining;
  L energy;            ///< at the start; only where it is kept
  LaneWalls<L> walls;  ///< only of who slides along one
  BasicMotion<L> end;
  unsigned active;   ///< lanes that hold a louse
  unsigned special;  ///< lanes that are left to the scalar step
  unsigned at_rim;   ///< started where walls and seams are
  unsigned sliding;  ///< of those, along a wall; only where such are stepped
  unsigned finished;
  state::Louse* lice[L::kCount];
  alignas(64) double after[L::kCount];

  /// Where the next sample is taken, and the pull there.
  [[gnu::always_inline]] inline void move_to(const G& ground, [[maybe_unused]] const state::Parameters& p,
                                             Pair<L> x) {
    ground.locate(x, place);
    if constexpr (F::central) drive.force.pull = -central_pull(x, p) * x;
  }

  /// Who has no thrust.
  [[nodiscard, gnu::always_inline]] inline typename L::Mask idle() const {
    return ~((drive.force.push > L(0.0)) | (drive.force.along < L(0.0)));
  }

  /// What central gravity has taken.
  [[nodiscard, gnu::always_inline]] inline L climbed(const state::Parameters& p) const {
    return central_potential(end.position, p) - central_potential(start.position, p);
  }
};

}  // namespace woodlouse::physics
