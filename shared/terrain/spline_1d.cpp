#include "shared/terrain/spline_1d.h"

#include <cassert>
#include <cstddef>

namespace woodlouse::terrain {
namespace {

/// Row i of the cyclic system is m[i-1] + 4 m[i] + m[i+1] = right[i], indices modulo p. With w = (1, 0 .. 0,
/// -1/4) and q = (-4, 0 .. 0, 1) it is T + q w', T tridiagonal with 8 and 17/4 in its corners; so m = y - x
/// (w'y) / (1 + w'x) where T y = right, T x = q.
void periodic_slopes(std::span<const double> z, double inverse, std::span<double> slopes) {
  const std::size_t p = z.size() - 1;
  std::vector<double> upper(p);
  std::vector<double> x(p);
  for (std::size_t i = 0; i < p; ++i) {
    const double next = z[i + 1 == p ? 0 : i + 1];
    const double previous = z[i == 0 ? p - 1 : i - 1];
    const double diagonal = i == 0 ? 8.0 : (i + 1 == p ? 4.25 : 4.0);
    const double pivot = 1.0 / (i == 0 ? diagonal : diagonal - upper[i - 1]);
    upper[i] = pivot;
    const double q = i == 0 ? -4.0 : (i + 1 == p ? 1.0 : 0.0);
    slopes[i] = pivot * (3.0 * inverse * (next - previous) - (i == 0 ? 0.0 : slopes[i - 1]));
    x[i] = pivot * (q - (i == 0 ? 0.0 : x[i - 1]));
  }
  for (std::size_t i = p - 1; i-- > 0;) {
    slopes[i] -= upper[i] * slopes[i + 1];
    x[i] -= upper[i] * x[i + 1];
  }
  const double factor = (slopes[0] - 0.25 * slopes[p - 1]) / (1.0 + x[0] - 0.25 * x[p - 1]);
  for (std::size_t i = 0; i < p; ++i) slopes[i] -= factor * x[i];
  slopes[p] = slopes[0];
}

}  // namespace

void spline_slopes(std::span<const double> values, double spacing, SplineEnds ends,
                   std::span<double> slopes) {
  const std::size_t n = values.size();
  assert(spacing > 0.0 && slopes.size() == n);
  assert(n >= (ends == SplineEnds::kNatural ? 2u : 4u));
  const auto& z = values;
  const double inverse = 1.0 / spacing;
  if (ends == SplineEnds::kPeriodic) return periodic_slopes(z, inverse, slopes);

  // Forward elimination: upper[i] is row i's factor of m[i+1], slopes[i] its right side.
  std::vector<double> upper(n);
  if (ends == SplineEnds::kNotAKnot) {
    upper[0] = 2.0;
    slopes[0] = 0.5 * inverse * (-5.0 * z[0] + 4.0 * z[1] + z[2]);
  } else {
    upper[0] = 0.5;
    slopes[0] = 1.5 * inverse * (z[1] - z[0]);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double pivot = 1.0 / (4.0 - upper[i - 1]);
    upper[i] = pivot;
    slopes[i] = pivot * (3.0 * inverse * (z[i + 1] - z[i - 1]) - slopes[i - 1]);
  }
  const std::size_t last = n - 1;
  if (ends == SplineEnds::kNotAKnot) {
    // 2 m[n-2] + m[n-1] = (5 z[n-1] - 4 z[n-2] - z[n-3]) / (2 h)
    const double right = 0.5 * inverse * (5.0 * z[last] - 4.0 * z[last - 1] - z[last - 2]);
    slopes[last] = (right - 2.0 * slopes[last - 1]) / (1.0 - 2.0 * upper[last - 1]);
  } else {
    // m[n-2] + 2 m[n-1] = 3 (z[n-1] - z[n-2]) / h
    const double right = 3.0 * inverse * (z[last] - z[last - 1]);
    slopes[last] = (right - slopes[last - 1]) / (2.0 - upper[last - 1]);
  }
  for (std::size_t i = last; i-- > 0;) slopes[i] -= upper[i] * slopes[i + 1];
}

}  // namespace woodlouse::terrain
