// The spline's batched evaluation as the batched step does it (physics/lanes/kernel.h), by itself, to be
// timed.
#pragma once

#include <cstddef>

#include "shared/physics/batch.h"

namespace woodlouse::lab {

struct LaneEvaluation {
  int width = 0;
  /// The sum of z, gradient and Hessian over n points, n a multiple of `width`.
  double (*sum)(const terrain::BicubicSpline::View& spline, const double* x, const double* y,
                std::size_t n) = nullptr;
};

LaneEvaluation avx2_evaluation();
LaneEvaluation avx512_evaluation();
/// Width 0 where this machine or this build has not that set.
LaneEvaluation find_lane_evaluation(physics::InstructionSet set);

}  // namespace woodlouse::lab
