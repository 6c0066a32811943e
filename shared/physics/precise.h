// `precise`: Nystrom-4 that keeps to one cell's polynomial through a step and ends the step where it leaves the
// cell. A C2 spline's third derivative jumps at knot lines, which caps any order at about 2 where a step crosses
// one; within a cell the surface is a polynomial and the order is 4.
//
// The crossing is the first root of the cubic Hermite of the step's ends in time; the polynomials of both cells
// agree to second order at the line, so an error e of the root costs of the order e^3.
#pragma once

#include <algorithm>
#include <type_traits>

#include "shared/physics/integrators.h"
#include "shared/terrain/bicubic_spline.h"

namespace woodlouse::physics {

/// One for each louse and tick: it remembers in which cell the next sub-step runs.
class Precise {
 public:
  static constexpr bool kSubSteps = true;

  template <typename Start, typename Field>
  StepResult step(const Start& start, const Field& field, double h) {
    const auto& spline = field.surface();
    if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(spline)>, terrain::BicubicSpline>) {
      return Nystrom4{}.step(start, field, h);  // no cells: nothing to split
    } else {
      if (!known_) cell_ = spline.cell_at(start.at.position.x, start.at.position.y);
      const auto sample = [&](core::Vec2 x) { return field.at(spline.sample_in(cell_, x.x, x.y), x); };
      const auto accelerate = [&](const auto& s, core::Vec2 v) { return field.accelerate(s, v); };
      const auto run = [&](double t) { return nystrom4(start.at, start.acceleration, t, sample, accelerate); };
      Motion end = run(h);
      const Exit exit = first_exit(spline.bounds(cell_), start.at, end, h);
      next_ = cell_;
      if (exit.time >= h) return {end, h};
      next_ = {cell_.column + exit.columns, cell_.row + exit.rows};
      // Never a step of nothing: the line it starts on is behind it.
      const double t = std::max(exit.time, 1e-9 * h);
      return {run(t), t};
    }
  }

  /// The last step() is the one that is taken; `turned`: something else (a wall, a stop) cut it short.
  void accept(bool turned) {
    known_ = !turned;
    cell_ = next_;
  }

 private:
  struct Exit {
    double time;
    int columns = 0;
    int rows = 0;
  };

  /// When p(t), the cubic with these ends, first reaches zero from below; h when it does not.
  static double first_root(double p0, double v0, double p1, double v1, double h) {
    if (!(p1 > 0.0)) return h;
    double low = 0.0;
    double high = h;
    for (int i = 0; i < 60 && high - low > 1e-14 * h; ++i) {
      const double t = 0.5 * (low + high);
      const double s = t / h;
      const double p = p0 * (1 + 2 * s) * (1 - s) * (1 - s) + v0 * t * (1 - s) * (1 - s) + p1 * s * s * (3 - 2 * s) +
                       v1 * h * s * s * (s - 1);
      (p > 0.0 ? high : low) = t;
    }
    return high;
  }

  static Exit first_exit(const terrain::Rectangle& box, const Motion& a, const Motion& b, double h) {
    Exit exit{h};
    const auto consider = [&](double time, int columns, int rows) {
      if (time < exit.time) exit = {time, columns, rows};
    };
    consider(first_root(a.position.x - box.x_max, a.velocity.x, b.position.x - box.x_max, b.velocity.x, h), 1, 0);
    consider(first_root(box.x_min - a.position.x, -a.velocity.x, box.x_min - b.position.x, -b.velocity.x, h), -1, 0);
    consider(first_root(a.position.y - box.y_max, a.velocity.y, b.position.y - box.y_max, b.velocity.y, h), 0, 1);
    consider(first_root(box.y_min - a.position.y, -a.velocity.y, box.y_min - b.position.y, -b.velocity.y, h), 0, -1);
    return exit;
  }

  bool known_ = false;
  terrain::BicubicSpline::CellIndex cell_;
  terrain::BicubicSpline::CellIndex next_;
};

}  // namespace woodlouse::physics
