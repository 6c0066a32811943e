// The batched step compiled for AVX2; see CMakeLists.txt for its flags.
#include "shared/core/lanes_avx2.h"
#include "shared/physics/lanes/kernels.h"

namespace woodlouse::physics {

BatchStep find_avx2_step(BatchGround ground, const BatchForces& forces) {
  return choose_kernel<core::Lanes4>(ground, forces);
}

}  // namespace woodlouse::physics
