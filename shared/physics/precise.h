// `precise`: Nystrom-4 that keeps to one cell's polynomial through a step and ends the step where it leaves
// the cell. A C2 spline's third derivative jumps at knot lines, which caps any order at about 2 where a step
// crosses one; within a cell the surface is a polynomial and the order is 4.
//
// The crossing is the first root of the cubic Hermite of the step's ends in time; the polynomials of both
// cells agree to second order at the line, so an error e of the root costs of the order e^3.
#pragma once

#include <algorithm>
#include <limits>

#include "shared/physics/integrators.h"
#include "shared/physics/rim.h"
#include "shared/terrain/bicubic_spline.h"

namespace woodlouse::physics {

/// One for each louse and tick: it remembers in which cell the next sub-step runs.
class Precise {
 public:
  static constexpr bool kSubSteps = true;
  static constexpr bool kKeepsEnergy = true;
  static constexpr int kSamples = 8;

  template <typename Start, typename Field>
  StepResult step(const Start& start, const Field& field, double h) {
    const auto& spline = field.surface();
    if constexpr (!requires { spline.cell_at(0.0, 0.0); }) {
      return Nystrom4{}.step(start, field, h);  // no cells: nothing to split
    } else {
      if (!known_) cell_ = spline.cell_at(start.at.position.x, start.at.position.y);
      const auto sample = [&](core::Vec2 x) { return field.at(spline.sample_in(cell_, x.x, x.y), x); };
      const auto run = [&](double t) {
        return field.turns() ? Nystrom4::turning_step(start, field, t, sample)
                             : Nystrom4::straight_step(start, field, t, sample);
      };
      const terrain::Rectangle cell = spline.bounds(cell_);
      const StepResult whole = run(h);
      const Exit exit = first_exit(cell, start.at, whole.end, h);
      next_ = cell_;
      if (exit.columns == 0 && exit.rows == 0) return whole;
      next_ = {cell_.column + exit.columns, cell_.row + exit.rows};
      // Never a step of nothing: the line it starts on is behind it.
      StepResult result = run(std::max(exit.time, 1e-9 * h));
      // The cell's polynomial says nothing of what lies beyond it, but for the little that the line is missed
      // by.
      if (!is_near(cell, result.end.position)) result.gain.energy = std::numeric_limits<double>::infinity();
      return result;
    }
  }

  /// The last step() is the one that is taken; `turned`: something else (a wall, a stop) cut it short.
  void accept(bool turned) {
    known_ = !turned;
    cell_ = next_;
  }

  /// The louse was carried over a seam by whole periods: the cell that it is in goes along.
  template <terrain::Surface S>
  void carried(const S& surface, Turns turns) requires requires {
    surface.cells();
  }
  {
    cell_.column -= turns.x * surface.cells().column;
    cell_.row -= turns.y * surface.cells().row;
  }

 private:
  struct Exit {
    double time;
    int columns = 0;
    int rows = 0;
  };

  /// A step's way along an axis: position and velocity at its ends.
  struct Way {
    double from, from_velocity, to, to_velocity;
  };

  static bool is_near(const terrain::Rectangle& box, core::Vec2 p) {
    constexpr double kNear = 1e-3;  // of its sides
    const double x = kNear * (box.x_max - box.x_min);
    const double y = kNear * (box.y_max - box.y_min);
    return p.x >= box.x_min - x && p.x <= box.x_max + x && p.y >= box.y_min - y && p.y <= box.y_max + y;
  }

  /// When the cubic through these ends reaches `line`, which its end lies beyond: Newton's method from that
  /// end, inside a bracket. It doubles its digits with each turn, so one that moved by kNear is as exact as
  /// doubles are.
  static double crossing(const Way& way, double line, double h) {
    constexpr double kNear = 1e-8;
    const double sign = way.to > line ? 1.0 : -1.0;  // p < 0 before the line
    const double p0 = sign * (way.from - line);
    const double v0 = sign * way.from_velocity * h;
    const double p1 = sign * (way.to - line);
    const double v1 = sign * way.to_velocity * h;
    // p(s) = p0 + v0 s + c s^2 + d s^3, s = t / h
    const double c = 3.0 * (p1 - p0) - 2.0 * v0 - v1;
    const double d = 2.0 * (p0 - p1) + v0 + v1;
    double low = 0.0;
    double high = 1.0;
    double s = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double p = ((d * s + c) * s + v0) * s + p0;
      const double slope = (3.0 * d * s + 2.0 * c) * s + v0;
      (p > 0.0 ? high : low) = s;
      const double newton = s - p / slope;  // infinite or NaN where the slope is 0
      const bool trusted = newton >= low && newton <= high;
      const double next = trusted ? newton : 0.5 * (low + high);
      const double moved = next > s ? next - s : s - next;
      s = next;
      if (moved <= (trusted ? kNear : 1e-14)) break;
    }
    return s * h;
  }

  /// The first line of the cell's box that a step over h from a to b crosses. One whose end lies within is
  /// taken to stay there.
  static Exit first_exit(const terrain::Rectangle& box, const Motion& a, const Motion& b, double h) {
    Exit exit{h};
    if (box.contains(b.position.x, b.position.y)) return exit;
    const int columns = b.position.x > box.x_max ? 1 : (b.position.x < box.x_min ? -1 : 0);
    const int rows = b.position.y > box.y_max ? 1 : (b.position.y < box.y_min ? -1 : 0);
    if (columns != 0) {
      const Way way{a.position.x, a.velocity.x, b.position.x, b.velocity.x};
      exit = {crossing(way, columns > 0 ? box.x_max : box.x_min, h), columns, 0};
    }
    if (rows != 0) {
      const Way way{a.position.y, a.velocity.y, b.position.y, b.velocity.y};
      const double time = crossing(way, rows > 0 ? box.y_max : box.y_min, h);
      if (columns == 0 || time < exit.time) exit = {time, 0, rows};
    }
    return exit;
  }

  bool known_ = false;
  terrain::BicubicSpline::CellIndex cell_;
  terrain::BicubicSpline::CellIndex next_;
};

}  // namespace woodlouse::physics
