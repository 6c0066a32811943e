#include "shared/document/biquadratic.h"

#include <catch2/catch.hpp>

#include "shared/terrain/function_surface.h"
#include "tests/support/csv.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

TEST_CASE("the biquadratic equals the document's, chapter 3.6, to 1e-12") {
  const tests::CsvTable table = tests::read_reference("surfaces.csv");
  REQUIRE(table.rows.size() == 300);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto name = function_from_text(table.text(row, "surface"));
    REQUIRE(name.has_value());
    const Biquadratic surface(sample_function(*name, 1.0, static_cast<std::size_t>(table.number(row, "g"))));
    const SurfaceSample s = surface.sample(table.number(row, "x"), table.number(row, "y"));
    INFO("row " << row);
    REQUIRE(s.z == Approx(table.number(row, "biquad_z")).margin(1e-12).epsilon(0));
    REQUIRE(s.zx == Approx(table.number(row, "biquad_zx")).margin(1e-12).epsilon(0));
    REQUIRE(s.zy == Approx(table.number(row, "biquad_zy")).margin(1e-12).epsilon(0));
  }
}

TEST_CASE("the biquadratic is exact on biquadratic polynomials, up to the rim and beyond it") {
  const auto p = [](double x) { return 0.3 - 0.7 * x + 0.4 * x * x; };
  const auto dp = [](double x) { return -0.7 + 0.8 * x; };
  const auto q = [](double y) { return -1.1 + 0.2 * y - 0.5 * y * y; };
  const auto dq = [](double y) { return 0.2 - 1.0 * y; };
  const Biquadratic surface(tests::grid_of(7, 5, [&](double x, double y) { return p(x) * q(y); }));
  const Rectangle d = surface.domain();
  tests::at_random_points({d.x_min - 0.5, d.y_min - 0.5, d.x_max + 0.5, d.y_max + 0.5}, 1000, 1,
                          [&](double x, double y) {
                            const SurfaceSample s = surface.sample(x, y);
                            REQUIRE(s.z == Approx(p(x) * q(y)).margin(1e-12));
                            REQUIRE(s.zx == Approx(dp(x) * q(y)).margin(1e-11));
                            REQUIRE(s.zy == Approx(p(x) * dq(y)).margin(1e-11));
                          });
}

TEST_CASE("the biquadratic's gradient is the derivative of its height within a stencil's reach") {
  const HeightGrid grid = tests::random_grid(12, 9, 5);
  const Biquadratic surface(grid);
  const double h = 1e-5;
  int tried = 0;
  tests::at_random_points(surface.domain(), 1000, 7, [&](double x, double y) {
    const auto [column, row] = tests::in_knots(grid, x, y);
    if (tests::to_half(column) < 1e-3 || tests::to_half(row) < 1e-3) return;
    ++tried;
    const SurfaceSample s = surface.sample(x, y);
    REQUIRE(s.zx == Approx((surface.sample(x + h, y).z - surface.sample(x - h, y).z) / (2 * h)).margin(1e-8));
    REQUIRE(s.zy == Approx((surface.sample(x, y + h).z - surface.sample(x, y - h).z) / (2 * h)).margin(1e-8));
  });
  CHECK(tried > 900);
}

TEST_CASE("halfway between knots the biquadratic's height jumps by h^3 z'''/8") {
  const double h = 0.5, third = 6.0;  // z = x^3 at spacing 0.5
  const Biquadratic surface(tests::grid_of(9, 4, [](double x, double) { return x * x * x; }));
  const double x = -1.5 + 3.5 * h;
  const double jump = surface.sample(x + 1e-9, 2.6).z - surface.sample(x - 1e-9, 2.6).z;
  CHECK(std::fabs(jump) == Approx(h * h * h * third / 8.0).epsilon(1e-6));
}

TEST_CASE("a point halfway belongs to the even knot, counted from the middle one, as Pascal's Round has it") {
  // Eleven knots: the middle is knot 5, even knots lie at 1, 3, 5, 7, 9.
  CHECK(nearest_inner_knot(4.5, 11) == 5);
  CHECK(nearest_inner_knot(5.5, 11) == 5);
  CHECK(nearest_inner_knot(6.5, 11) == 7);
  CHECK(nearest_inner_knot(3.5, 11) == 3);
  // Nine knots: the middle is knot 4.
  CHECK(nearest_inner_knot(3.5, 9) == 4);
  CHECK(nearest_inner_knot(4.5, 9) == 4);
  CHECK(nearest_inner_knot(5.5, 9) == 6);
}

TEST_CASE("the stencil's centre never leaves the inner knots") {
  for (const double position : {-1e300, -5.0, 0.0, 0.4, 0.6, 1.0})
    CHECK(nearest_inner_knot(position, 6) == 1);
  for (const double position : {4.0, 4.6, 5.0, 9.0, 1e300}) CHECK(nearest_inner_knot(position, 6) == 4);
  CHECK(nearest_inner_knot(std::nan(""), 6) == 1);
  CHECK(nearest_inner_knot(1.0, 3) == 1);
}
