#include "shared/core/portable_trigonometry.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/core/random.h"

using woodlouse::core::portable_sincos;
using woodlouse::core::Random;

TEST_CASE("portable sin and cos agree with the long double library to one unit in the last place") {
  Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double range = i % 2 == 0 ? 10.0 : 1e5;
    const double x = (2.0 * random.uniform() - 1.0) * range;
    const auto [s, c] = portable_sincos(x);
    const long double exact_s = std::sin(static_cast<long double>(x));
    const long double exact_c = std::cos(static_cast<long double>(x));
    const auto ulps = [](double got, long double exact) {
      const double rounded = static_cast<double>(exact);
      const double ulp = std::nextafter(std::fabs(rounded), 2.0) - std::fabs(rounded);
      return static_cast<double>(std::fabs(got - exact) / ulp);
    };
    worst = std::max({worst, ulps(s, exact_s), ulps(c, exact_c)});
  }
  CHECK(worst < 1.0);
}

TEST_CASE("portable sin and cos are exact where they must be") {
  CHECK(portable_sincos(0.0).sin == 0.0);
  CHECK(portable_sincos(0.0).cos == 1.0);
  CHECK(portable_sincos(-0.75).sin == -portable_sincos(0.75).sin);
  CHECK(portable_sincos(-0.75).cos == portable_sincos(0.75).cos);
}
