// The steps on one kind of ground behind one indirect call per tick: each kind is compiled in a file of its
// own (steps_on_*.cpp, from compiled_steps.h), so that they build side by side and the world knows none of
// them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "shared/physics/batch.h"
#include "shared/physics/step_counters.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"
#include "shared/state/step_events.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::physics {

/// Immutable: any thread may call. Refers to the surface it was made for.
class GroundSteps {
 public:
  GroundSteps() = default;
  GroundSteps(const GroundSteps&) = delete;
  GroundSteps& operator=(const GroundSteps&) = delete;
  virtual ~GroundSteps() = default;

  /// Moves lice[moving[0]], lice[moving[1]], ..., none of them resting, through one tick. batch: for as many
  /// at once as it can; width 0: none, and so REQUIRED but of the default method on the bicubic spline and on
  /// the plane. lists: room for it. events: one a louse of `lice`, what happened to it is added.
  virtual void advance(std::span<state::Louse> lice, std::span<const std::uint32_t> moving,
                       const BatchStep& batch, BatchLists& lists, StepCounters& counters,
                       std::span<state::StepEvents> events) const = 0;
  /// Whether friction, brake and walls hold this louse where it is.
  [[nodiscard]] virtual bool holds(const state::Louse& louse) const = 0;
};

/// What the steps need besides the ground.
struct StepRules {
  state::Parameters parameters;
  terrain::Rectangle walls;
  double tick = 0.0;  ///< [s]
};

std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::BicubicSpline& ground,
                                                     const StepRules& rules);
std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::FunctionSurface& ground,
                                                     const StepRules& rules);
std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::TiledGround& ground,
                                                     const StepRules& rules);
std::unique_ptr<const GroundSteps> make_ground_steps(const terrain::PlaneSurface& ground,
                                                     const StepRules& rules);

}  // namespace woodlouse::physics
