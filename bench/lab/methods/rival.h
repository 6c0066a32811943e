// Other people's splines over the same heights, behind one call a block of points.
#pragma once

#include <memory>
#include <span>

#include "shared/core/vec2.h"
#include "shared/terrain/height_grid.h"

namespace woodlouse::lab {

class Rival {
 public:
  Rival() = default;
  Rival(const Rival&) = delete;
  Rival& operator=(const Rival&) = delete;
  virtual ~Rival() = default;
  /// The sum over the points of everything it computes.
  [[nodiscard]] virtual double sum(std::span<const core::Vec2> points) const = 0;
};

/// GSL's bicubic gsl_spline2d with its accelerators: z, gradient and Hessian in six calls, or z and gradient
/// in three. Null: not built.
std::unique_ptr<Rival> gsl_six_calls(const terrain::HeightGrid& grid);
std::unique_ptr<Rival> gsl_three_calls(const terrain::HeightGrid& grid);
/// ALGLIB's spline2ddiff over spline2dbuildbicubicv: z and gradient (and the mixed derivative). Null: not
/// built.
std::unique_ptr<Rival> alglib_differentiation(const terrain::HeightGrid& grid);
/// vspline's evaluators of a natural cubic b-spline (vspline_sum.h): z, gradient and Hessian. The grid
/// outlives it. REQUIRES blocks of points that vectors fill. Null: not built, or no AVX2.
std::unique_ptr<Rival> vspline_six_evaluators(const terrain::HeightGrid& grid);

}  // namespace woodlouse::lab
