// The batched evaluation compiled for AVX-512; see CMakeLists.txt for its flags.
#include "shared/core/lanes_avx512.h"
#include "bench/lab/methods/lanes_kernel.h"

namespace woodlouse::lab {

LaneEvaluation avx512_evaluation() { return {core::Lanes8::kCount, sum_of_lanes<core::Lanes8>}; }

}  // namespace woodlouse::lab
