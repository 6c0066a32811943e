// Several lice at once: the step's common case in AVX2 (4 lanes) or AVX-512 (8), chosen at run time.
//
// The common case is a louse that moves, away from the walls, whose tick needs no sub-steps and ends inside: one
// Nystrom-4 step. A lane that is anything else is left untouched, for the scalar step. The lanes run the very
// templates of the scalar step (surface_motion.h, nystrom.h, sub_step_rules.h, terrain's evaluate_cell), so that
// the bits are the same whichever way a louse was stepped.
#pragma once

#include "shared/physics/louse.h"
#include "shared/physics/parameters.h"
#include "shared/physics/sub_step_rules.h"
#include "shared/terrain/bicubic_spline.h"

namespace woodlouse::physics {

enum class InstructionSet { kScalar, kAvx2, kAvx512 };

/// "scalar", "avx2", "avx512".
const char* to_text(InstructionSet set);
/// Whether this machine has it and this build too.
bool is_available(InstructionSet set);
/// The widest that is available.
InstructionSet best_instruction_set();

/// What a batch reads besides its lice.
struct BatchContext {
  terrain::BicubicSpline::View spline;
  Parameters parameters;
  terrain::Rectangle walls;
  double tick = 0.0;
  SubStepRules rules;
};

/// Steps `width` lice, none of them resting; bit l of the result: lice[l] was stepped.
struct BatchStep {
  int width = 0;
  unsigned (*advance)(const BatchContext&, Louse* const* lice) = nullptr;
};

/// The batched step of an instruction set for a map's forces; width 0 for kScalar and what is not available.
BatchStep find_batch_step(InstructionSet set, bool drag, bool friction, bool thrust);

}  // namespace woodlouse::physics
