// A louse's path over a surface, place by place.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/lab/methods/laboratory.h"
#include "shared/core/vec2.h"

namespace woodlouse::lab {

struct PathPoint {
  double t = 0.0;  ///< [s]
  core::Vec2 position;
  double z = 0.0;  ///< the surface's height [m]
  core::Vec2 velocity;
  double energy = 0.0;  ///< kinetic and that of gravity, per mass [J/kg]
};

struct PathMethod {
  Equations equations;
  Integrator integrator;
  std::size_t steps_a_point = 1;  ///< >= 1
};

/// How the document moves its mass point.
inline constexpr PathMethod kAsPrinted{Equations::kAsPrinted, Integrator::kFalseEuler};

struct Journey {
  core::Vec2 from;      ///< [m]
  core::Vec2 velocity;  ///< [m/s]
  double rate;          ///< points a second [Hz]
  double seconds;
};

/// The start and every point after it; there are no walls. Errors: as make_stepper.
core::Expected<std::vector<PathPoint>> path_over(const document::AnySurface& surface,
                                                 const PathMethod& method,
                                                 const state::Parameters& parameters, const Journey& journey);

}  // namespace woodlouse::lab
