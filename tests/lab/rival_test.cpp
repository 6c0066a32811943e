// That the splines which the lab compares with compute what they are compared in.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "bench/lab/methods/rival.h"

using namespace woodlouse;
using namespace woodlouse::lab;

TEST_CASE("each rival's sum over a plane is that of its heights and slopes") {
  terrain::HeightGrid grid{12, 9, 0.0, 0.0, 1.0, 1.0, {}};
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 12; ++i) grid.heights.push_back(2.0 * i + 3.0 * j);
  std::vector<core::Vec2> points;
  double expected = 0.0;
  for (int k = 0; k < 16; ++k) {
    points.push_back({0.5 + 0.61 * k, 0.25 + 0.43 * k});
    expected += 2.0 * points.back().x + 3.0 * points.back().y + 5.0;
  }
  for (const auto& rival : {gsl_six_calls(grid), gsl_three_calls(grid), alglib_differentiation(grid),
                            vspline_six_evaluators(grid)})
    if (rival != nullptr) CHECK(rival->sum(points) == Approx(expected).epsilon(1e-12));
}
