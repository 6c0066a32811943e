#include "shared/physics/batch.h"

#include <cassert>

#include "shared/core/instruction_sets.h"

namespace woodlouse::physics {

/// Of core.wasm: lanes/simd128.cpp.
BatchStep find_scalar_step(BatchGround ground, const BatchForces& forces);
#ifdef WOODLOUSE_X86_LANES
BatchStep find_avx2_step(BatchGround ground, const BatchForces& forces);
BatchStep find_avx512_step(BatchGround ground, const BatchForces& forces);
#endif

const char* to_text(InstructionSet set) {
  switch (set) {
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kAvx512:
      return "avx512";
    default:
      return "scalar";
  }
}

bool is_available(InstructionSet set) {
  if (set == InstructionSet::kScalar) return true;
#ifdef WOODLOUSE_X86_LANES
  return set == InstructionSet::kAvx2 ? core::has_avx2() : core::has_avx512();
#else
  return false;
#endif
}

InstructionSet best_instruction_set() {
  for (const InstructionSet set : {InstructionSet::kAvx512, InstructionSet::kAvx2}) {
    if (is_available(set)) return set;
  }
  return InstructionSet::kScalar;
}

BatchStep find_batch_step(InstructionSet set, BatchGround ground, const BatchForces& forces) {
  assert(is_available(set));
#ifdef WOODLOUSE_X86_LANES
  if (set == InstructionSet::kAvx2) return find_avx2_step(ground, forces);
  if (set == InstructionSet::kAvx512) {
    BatchStep step = find_avx512_step(ground, forces);
    if (!is_available(InstructionSet::kAvx2)) return step;
    const BatchStep narrow = find_avx2_step(ground, forces);
    step.advance_few = narrow.advance;
    step.go_on_few = narrow.go_on;
    return step;
  }
#endif
  return find_scalar_step(ground, forces);
}

}  // namespace woodlouse::physics
