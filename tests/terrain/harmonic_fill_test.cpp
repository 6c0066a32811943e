#include "shared/terrain/harmonic_fill.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "shared/core/random.h"

using namespace woodlouse;

namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

struct FilledCase {
  std::size_t columns;
  std::size_t rows;
  double aspect;  ///< dx / dy
};

/// Harmonic on the knots themselves: x^2 - y^2 and x y are zeros of the discrete operator too.
double harmonic(const FilledCase& c, std::size_t i, std::size_t j) {
  const double x = (static_cast<double>(i) / static_cast<double>(c.columns)) * c.aspect;
  const double y = static_cast<double>(j) / static_cast<double>(c.columns);
  return 3.0 * (x * x - y * y) + 2.0 * x * y - x + 0.5 * y + 7.0;
}

/// The largest error after `is_missing(i, j)` was filled.
template <typename IsMissing>
double error_of(const FilledCase& c, const IsMissing& is_missing) {
  std::vector<double> heights;
  for (std::size_t j = 0; j < c.rows; ++j) {
    for (std::size_t i = 0; i < c.columns; ++i)
      heights.push_back(is_missing(i, j) ? kNoHeight : harmonic(c, i, j));
  }
  terrain::fill_harmonically(heights, c.columns, c.aspect, 1.0);
  double worst = 0.0;
  for (std::size_t k = 0; k < heights.size(); ++k)
    worst = std::fmax(worst, std::fabs(heights[k] - harmonic(c, k % c.columns, k / c.columns)));
  return worst;
}

bool in_lake(std::size_t i, std::size_t j, double radius, std::size_t middle) {
  const double x = static_cast<double>(i) - static_cast<double>(middle);
  const double y = static_cast<double>(j) - static_cast<double>(middle);
  return x * x + y * y < radius * radius;
}

}  // namespace

TEST_CASE("a hole of any size takes the harmonic function that its shore has") {
  CHECK(error_of({40, 30, 1.0}, [](auto i, auto j) { return i == 17 && j == 9; }) < 1e-12);
  for (const double side : {5.0, 20.0, 77.0, 150.0}) {
    const std::size_t n = 2 * static_cast<std::size_t>(side) + 11;
    INFO(side);
    CHECK(error_of({n, n, 1.0}, [&](auto i, auto j) { return in_lake(i, j, side, n / 2); }) < 6e-6);
    CHECK(error_of({n, n, 0.6}, [&](auto i, auto j) { return in_lake(i, j, side, n / 2); }) < 6e-6);
    CHECK(error_of({n, n, 1.0}, [&](auto i, auto j) { return i > 3 && j > 3 && i + 5 < n && j + 4 < n; }) <
          6e-6);
  }
}

TEST_CASE("islands, two fifths of all knots missing, and a checkerboard are filled as exactly") {
  core::Random random(5);
  CHECK(error_of({101, 90, 1.0}, [&](auto i, auto j) {
          return i > 0 && j > 0 && i < 100 && j < 89 && random.uniform() < 0.4;
        }) < 6e-6);
  CHECK(error_of({100, 91, 1.0}, [](auto i, auto j) {
          return i > 0 && j > 0 && i < 99 && j < 90 && (i + j) % 2 == 0;
        }) < 6e-6);
  CHECK(error_of({201, 201, 1.0}, [&](auto i, auto j) {
          return in_lake(i, j, 90.0, 100) && !in_lake(i, j, 10.0, 100) && random.uniform() < 0.99;
        }) < 3e-4);
}

TEST_CASE("a rim that is missing is filled level across, and no filled height leaves the shore's range") {
  const std::size_t n = 64;
  std::vector<double> heights(n * n, kNoHeight);
  core::Random random(9);
  for (std::size_t k = 0; k < n; ++k) heights[random.next() % heights.size()] = random.uniform();
  double low = 1.0, high = 0.0;
  for (const double z : heights) {
    if (!std::isfinite(z)) continue;
    low = std::fmin(low, z);
    high = std::fmax(high, z);
  }
  const std::vector<double> given = heights;
  terrain::fill_harmonically(heights, n, 30.0, 20.0);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    REQUIRE(heights[k] >= low - 1e-6);
    REQUIRE(heights[k] <= high + 1e-6);
    if (std::isfinite(given[k])) REQUIRE(heights[k] == given[k]);
  }
  std::vector<double> strip(20, kNoHeight);
  strip[0] = strip[10] = 4.0;
  terrain::fill_harmonically(strip, 10, 1.0, 1.0);
  for (const double z : strip) CHECK(z == Approx(4.0).margin(1e-9));
}

TEST_CASE("a grid of one known height is level, and one without holes is left as it is") {
  std::vector<double> heights(37 * 23, kNoHeight);
  heights[400] = 12.5;
  terrain::fill_harmonically(heights, 37, 1.0, 1.0);
  for (const double z : heights) CHECK(z == Approx(12.5).margin(1e-9));
  std::vector<double> whole{1.0, 2.0, 4.0, 8.0};
  terrain::fill_harmonically(whole, 2, 1.0, 1.0);
  CHECK(whole == std::vector<double>{1.0, 2.0, 4.0, 8.0});
}
