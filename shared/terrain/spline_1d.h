// The one-dimensional cubic spline through equally spaced values: slopes at the knots.
//
// Unknowns are the knots' slopes m_i (the document, chapter 5.2, takes the curvatures; both are the same
// spline). C2 at inner knots gives, with spacing h,
//     m[i-1] + 4 m[i] + m[i+1] = 3 (z[i+1] - z[i-1]) / h.
// Ends:
//     natural     curvature zero: 2 m0 + m1 = 3 (z1 - z0) / h
//     not-a-knot  third derivative continuous at the second knot: m0 + 2 m1 = (-5 z0 + 4 z1 + z2) / (2 h)
//     periodic    the last knot is the first again: n values, n - 1 unknowns, m[-1] = m[n-2]. The last value
//                 is not read. The cyclic system is the tridiagonal one plus a correction of rank one
//                 (Sherman-Morrison): two eliminations.
// Solved by elimination without pivoting (the system is diagonally dominant after the first row), O(n).
#pragma once

#include <span>
#include <vector>

namespace woodlouse::terrain {

enum class SplineEnds { kNotAKnot, kNatural, kPeriodic };

/// The spline's slopes at its knots, written to `slopes` (same length as `values`).
/// REQUIRES spacing > 0 and values.size() >= 4 (not-a-knot, periodic) or >= 2 (natural).
void spline_slopes(std::span<const double> values, double spacing, SplineEnds ends, std::span<double> slopes);

}  // namespace woodlouse::terrain
