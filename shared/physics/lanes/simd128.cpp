// The batched step in core.wasm, compiled for WebAssembly's vectors, which browsers of 2023 and later have:
// over a spline, by the forces of most maps. See CMakeLists.txt for its flags.
#include "shared/physics/lanes/simd128.h"
#include "shared/physics/lanes/kernels.h"

namespace woodlouse::physics {

/// In the place of lanes/scalar.cpp's: one lane has no more to give than the scalar step.
BatchStep find_scalar_step(BatchGround ground, const BatchForces& forces) {
  using L = core::Lanes2;
  using G = SplineLanes<L>;
  using F = ForcesWithAnyDrag<true, true>;
  if (ground != BatchGround::kBicubicSpline || forces.central || !forces.friction || !forces.thrust)
    return {};
  return {L::kCount, advance_lanes<L, F, G>, go_on_in_lanes<L, F, G>};
}

}  // namespace woodlouse::physics
