#include "shared/terrain/bspline_coefficients.h"

#include <cassert>
#include <vector>

namespace woodlouse::terrain {

void bspline_coefficients(std::span<const double> values, std::size_t lanes, std::span<double> coefficients) {
  const std::size_t n = values.size() / lanes;
  assert(n >= 4 && n * lanes == values.size() && coefficients.size() == (n + 2) * lanes);
  const auto z = [&](std::size_t k) { return values.data() + k * lanes; };
  const auto c = [&](std::size_t k_plus_1) {
    return coefficients.data() + k_plus_1 * lanes;
  };  // c(k + 1) is c[k]
  constexpr double kSixth = 1.0 / 6.0;
  const auto near_end = [&](std::size_t k, std::size_t outer, std::size_t inner, double* out) {
    const double *a = z(k), *b = z(outer), *d = z(inner);
    for (std::size_t lane = 0; lane < lanes; ++lane) out[lane] = kSixth * (8.0 * a[lane] - b[lane] - d[lane]);
  };
  near_end(1, 0, 2, c(2));
  near_end(n - 2, n - 1, n - 3, c(n - 1));

  std::vector<double> pivots(n, 0.0);  // pivots[1] = 0: c[1] is known
  for (std::size_t k = 2; k + 3 <= n; ++k) {
    pivots[k] = 1.0 / (4.0 - pivots[k - 1]);
    const double pivot = pivots[k];
    const double* right = z(k);
    const double* before = c(k);
    double* out = c(k + 1);
    for (std::size_t lane = 0; lane < lanes; ++lane) out[lane] = pivot * (6.0 * right[lane] - before[lane]);
  }
  for (std::size_t k = n - 3; k >= 2; --k) {
    const double pivot = pivots[k];
    const double* after = c(k + 2);
    double* out = c(k + 1);
    for (std::size_t lane = 0; lane < lanes; ++lane) out[lane] -= pivot * after[lane];
  }
  // The row of knot k, solved for its outer coefficient.
  const auto outward = [&](std::size_t k, const double* middle, const double* inner, double* out) {
    const double* right = z(k);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      out[lane] = 6.0 * right[lane] - 4.0 * middle[lane] - inner[lane];
  };
  outward(1, c(2), c(3), c(1));
  outward(0, c(1), c(2), c(0));
  outward(n - 2, c(n - 1), c(n - 2), c(n));
  outward(n - 1, c(n), c(n - 1), c(n + 1));
}

}  // namespace woodlouse::terrain
