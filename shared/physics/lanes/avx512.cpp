// The batched step compiled for AVX-512; see CMakeLists.txt for its flags.
#include "shared/core/lanes_avx512.h"
#include "shared/physics/lanes/kernels.h"

namespace woodlouse::physics {

BatchStep find_avx512_step(BatchGround ground, const BatchForces& forces) {
  return choose_kernel<core::Lanes8>(ground, forces);
}

}  // namespace woodlouse::physics
