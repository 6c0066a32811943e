// The batched step compiled for any machine.
#include "shared/core/lanes_scalar.h"
#include "shared/physics/lanes/kernels.h"

namespace woodlouse::physics {

BatchStep find_scalar_step(BatchGround ground, const BatchForces& forces) {
  return choose_kernel<core::Lanes1>(ground, forces);
}

}  // namespace woodlouse::physics
