// Many lice at once: the step's common case in AVX-512 (8 lanes), AVX2 (4) or plain doubles (1), chosen at
// run time.
//
// The common case is a louse that moves whose sub-steps stay above the cap and that does not halt: Nystrom-4
// steps on the ground, be it sliding along a wall, and pieces of flight. Whoever meets anything else (a wall,
// a seam, a corner, a stop, take-off and landing) is left where it was then, for the scalar step (stepper.h).
// The lanes run the very templates of the scalar step (surface_motion.h, nystrom.h, sub_step_rules.h,
// terrain's evaluate_cell) in its order, so that the bits are the same whichever way a louse was stepped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/physics/step_counters.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/terrain/bicubic_spline.h"

namespace woodlouse::physics {

enum class InstructionSet { kScalar, kAvx2, kAvx512 };

/// "scalar", "avx2", "avx512".
const char* to_text(InstructionSet set);
/// Whether this machine has it and this build too.
bool is_available(InstructionSet set);
/// The widest that is available.
InstructionSet best_instruction_set();

/// A louse on its way through a tick.
struct LouseTick {
  std::uint32_t index = 0;
  std::uint32_t pieces = 0;  ///< sub-steps and impacts so far
  double remaining = 0.0;    ///< of the tick [s]
};

/// Room for the lists of a batched step, kept from step to step.
struct BatchLists {
  std::vector<LouseTick> left;  ///< the result: whom the lanes can't step, or no further
  std::vector<LouseTick> now, again, at_wall, in_air;
};

struct BatchContext;

/// Steps those of lists.again through what is left of their tick, as BatchStep::advance does; at_wall: all of
/// them slide along one.
using GoOn = void (*)(const BatchContext&, state::Louse* lice, bool at_wall, BatchLists& lists,
                      StepCounters& counters);

/// So many lice are stepped sooner by four lanes than by eight, half of which do nothing.
inline constexpr std::size_t kFewLice = 4;

/// What a batch reads besides its lice.
struct BatchContext {
  /// See terrain::PlaneSurface.
  struct Plane {
    double height = 0.0;
    core::Vec2 corner, slope;
  };
  terrain::BicubicSpline::View spline;  ///< on BatchGround::kBicubicSpline
  Plane plane;                          ///< on BatchGround::kPlane
  state::Parameters parameters;
  terrain::Rectangle interior;  ///< who leaves it meets a wall or a seam
  double tick = 0.0;            ///< [s]
  SubStepRules rules;
  double cell = 0.0;   ///< the side of the ground's smallest [m]; infinite where it has none
  GoOn few = nullptr;  ///< for kFewLice and fewer; null: there is nothing narrower
};

/// Steps lice[i] for each i of `moving`, none of them resting, through a tick, where the common case holds;
/// the others are left where they were then, in lists.left.
struct BatchStep {
  using Advance = void (*)(const BatchContext&, state::Louse* lice, std::span<const std::uint32_t> moving,
                           BatchLists& lists, StepCounters& counters);
  int width = 0;  ///< lanes; 0: no batched step
  Advance advance = nullptr;
  GoOn go_on = nullptr;
  /// The same of narrower lanes, for kFewLice and fewer; null: there are none.
  Advance advance_few = nullptr;
  GoOn go_on_few = nullptr;

  [[nodiscard]] Advance advance_of(std::size_t lice) const {
    return lice <= kFewLice && advance_few != nullptr ? advance_few : advance;
  }
};

/// The grounds that have a batched step.
enum class BatchGround { kBicubicSpline, kPlane };

/// The forces a map has.
struct BatchForces {
  bool drag = false;
  bool friction = false;
  bool thrust = false;
  bool central = false;  ///< then the others are compiled in too
};

/// The batched step of an instruction set for a map's ground and forces; REQUIRES is_available(set).
BatchStep find_batch_step(InstructionSet set, BatchGround ground, const BatchForces& forces);

}  // namespace woodlouse::physics
