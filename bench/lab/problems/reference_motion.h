// The lab's own answer to where a louse is after a time, good to about 1e-13: what the integrators are
// measured against. It shares the equations with them, not the integrators.
//
// Dormand and Prince's fifth-order formula at a short fixed step. On a spline it keeps to one cell's
// polynomial and lands on each knot line (bisecting the length of the step, repeating it), so that no step
// straddles a jump of the third derivative. No dissipation, no walls: nothing there is singular.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "shared/core/vec2.h"
#include "shared/physics/nystrom.h"
#include "shared/physics/surface_motion.h"
#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/function_surface.h"

namespace woodlouse::lab {

namespace reference {

inline constexpr std::size_t kStages = 6;
inline constexpr double kNodes[kStages][kStages] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656}};
inline constexpr double kWeights[kStages] = {35.0 / 384,     0,        500.0 / 1113, 125.0 / 192,
                                             -2187.0 / 6784, 11.0 / 84};

/// One step of h where `sample` gives the surface.
template <typename Sample>
physics::Motion step(const physics::Motion& start, double h, const state::Parameters& p,
                     const Sample& sample) {
  std::array<core::Vec2, kStages> v;
  std::array<core::Vec2, kStages> a;
  for (std::size_t i = 0; i < kStages; ++i) {
    core::Vec2 x = start.position;
    v[i] = start.velocity;
    for (std::size_t j = 0; j < i; ++j) {
      x += (h * kNodes[i][j]) * v[j];
      v[i] += (h * kNodes[i][j]) * a[j];
    }
    a[i] = physics::acceleration<physics::Forces<false, false, false>>(sample(x), v[i], {}, p);
  }
  physics::Motion end = start;
  for (std::size_t i = 0; i < kStages; ++i) {
    end.position += (h * kWeights[i]) * v[i];
    end.velocity += (h * kWeights[i]) * a[i];
  }
  return end;
}

/// How far p is beyond the box [m]; negative inside.
inline double beyond(const terrain::Rectangle& box, core::Vec2 p) {
  return std::max(std::max(box.x_min - p.x, p.x - box.x_max), std::max(box.y_min - p.y, p.y - box.y_max));
}

}  // namespace reference

/// `at` after `seconds`, by steps of at most h.
inline physics::Motion reference_motion(const terrain::FunctionSurface& surface, physics::Motion at,
                                        double seconds, double h, const state::Parameters& p) {
  const auto steps = static_cast<std::size_t>(std::ceil(seconds / h));
  for (std::size_t i = 0; i < steps; ++i) {
    at = reference::step(at, seconds / static_cast<double>(steps), p,
                         [&](core::Vec2 x) { return surface.sample(x.x, x.y); });
  }
  return at;
}

inline physics::Motion reference_motion(const terrain::BicubicSpline& surface, physics::Motion at,
                                        double seconds, double h, const state::Parameters& p) {
  using CellIndex = terrain::BicubicSpline::CellIndex;
  constexpr double kFarOutside = 1e9;  // metres; a cell's number must fit into an integer
  const CellIndex last = surface.cell_at(kFarOutside, kFarOutside);
  CellIndex cell = surface.cell_at(at.position.x, at.position.y);
  double remaining = seconds;
  while (remaining > 0.0) {
    const auto run = [&](double t) {
      return reference::step(at, t, p, [&](core::Vec2 x) { return surface.sample_in(cell, x.x, x.y); });
    };
    // The edge's cells have no end outwards.
    terrain::Rectangle box = surface.bounds(cell);
    if (cell.column == 0) box.x_min = -1e300;
    if (cell.row == 0) box.y_min = -1e300;
    if (cell.column == last.column) box.x_max = 1e300;
    if (cell.row == last.row) box.y_max = 1e300;
    double t = std::fmin(h, remaining);
    physics::Motion end = run(t);
    if (reference::beyond(box, end.position) > 0.0) {
      double low = 0.0;
      double high = t;
      for (int i = 0; i < 100 && high - low > 1e-17; ++i) {
        t = 0.5 * (low + high);
        end = run(t);
        (reference::beyond(box, end.position) > 0.0 ? high : low) = t;
      }
      t = high;
      end = run(t);
      if (end.position.x > box.x_max) ++cell.column;
      if (end.position.x < box.x_min) --cell.column;
      if (end.position.y > box.y_max) ++cell.row;
      if (end.position.y < box.y_min) --cell.row;
    }
    at = end;
    remaining -= t;
  }
  return at;
}

}  // namespace woodlouse::lab
