// The batched evaluation compiled for AVX2; see CMakeLists.txt for its flags.
#include "shared/core/lanes_avx2.h"
#include "bench/lab/methods/lanes_kernel.h"

namespace woodlouse::lab {

LaneEvaluation avx2_evaluation() { return {core::Lanes4::kCount, sum_of_lanes<core::Lanes4>}; }

}  // namespace woodlouse::lab
