#include "shared/terrain/fill_missing.h"

#include <algorithm>
#include <cmath>

namespace woodlouse::terrain {
namespace {

/// The mean of the known heights around knot (i, j); NaN where there are none.
double mean_around(const std::vector<double>& heights, std::size_t columns, std::size_t i, std::size_t j) {
  const std::size_t rows = heights.size() / columns;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t row = j == 0 ? 0 : j - 1; row < std::min(j + 2, rows); ++row) {
    for (std::size_t column = i == 0 ? 0 : i - 1; column < std::min(i + 2, columns); ++column) {
      const double height = heights[row * columns + column];
      if (!std::isfinite(height)) continue;
      sum += height;
      count += 1.0;
    }
  }
  return sum / count;
}

}  // namespace

void fill_missing(std::vector<double>& heights, std::size_t columns, double level) {
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (!std::isfinite(heights[k])) missing.push_back(k);
  }
  std::vector<double> means;
  for (std::size_t round = 0; round < kFillReach && !missing.empty(); ++round) {
    // All means first: a round must not see its own fillings, else the order of knots would show.
    means.clear();
    for (const std::size_t k : missing)
      means.push_back(mean_around(heights, columns, k % columns, k / columns));
    std::size_t still = 0;
    for (std::size_t m = 0; m < missing.size(); ++m) {
      heights[missing[m]] = means[m];
      if (!std::isfinite(means[m])) missing[still++] = missing[m];
    }
    if (still == missing.size()) break;
    missing.resize(still);
  }
  for (const std::size_t k : missing) heights[k] = level;
}

}  // namespace woodlouse::terrain
