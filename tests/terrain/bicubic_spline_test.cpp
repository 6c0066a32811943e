#include "shared/terrain/bicubic_spline.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "shared/core/random.h"
#include "shared/terrain/terrain.h"
#include "tests/support/csv.h"

using namespace woodlouse;
using namespace woodlouse::terrain;

namespace {

/// A bicubic polynomial with its derivatives, on a grid whose axes differ in origin, spacing and count.
SurfaceSample bicubic(double x, double y) {
  const double p = 0.3 + x * (-0.7 + x * (0.11 + x * 0.05));
  const double px = -0.7 + x * (0.22 + x * 0.15);
  const double pxx = 0.22 + 0.30 * x;
  const double q = -1.1 + y * (0.4 + y * (-0.2 + y * 0.07));
  const double qy = 0.4 + y * (-0.4 + y * 0.21);
  const double qyy = -0.4 + 0.42 * y;
  return {p * q, px * q, p * qy, pxx * q, px * qy, p * qyy};
}

HeightGrid oblong_grid() {
  HeightGrid grid{9, 6, -2.0, 1.5, 0.5, 0.25, {}};
  for (std::size_t j = 0; j < grid.rows; ++j)
    for (std::size_t i = 0; i < grid.columns; ++i)
      grid.heights.push_back(
          bicubic(-2.0 + 0.5 * static_cast<double>(i), 1.5 + 0.25 * static_cast<double>(j)).z);
  return grid;
}

HeightGrid random_grid(std::size_t columns, std::size_t rows) {
  core::Random random(3);
  HeightGrid grid{columns, rows, -1.0, -2.0, 0.3, 0.7, {}};
  for (std::size_t k = 0; k < columns * rows; ++k) grid.heights.push_back(random.uniform());
  return grid;
}

}  // namespace

TEST_CASE("the not-a-knot spline is exact on bicubic polynomials, with gradient and Hessian") {
  const BicubicSpline spline(oblong_grid());
  core::Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const double x = -2.0 + 4.0 * random.uniform();
    const double y = 1.5 + 1.25 * random.uniform();
    const SurfaceSample got = spline.sample(x, y);
    const SurfaceSample exact = bicubic(x, y);
    REQUIRE(got.z == Approx(exact.z).margin(1e-13));
    REQUIRE(got.zx == Approx(exact.zx).margin(1e-12));
    REQUIRE(got.zy == Approx(exact.zy).margin(1e-12));
    REQUIRE(got.zxx == Approx(exact.zxx).margin(1e-11));
    REQUIRE(got.zxy == Approx(exact.zxy).margin(1e-11));
    REQUIRE(got.zyy == Approx(exact.zyy).margin(1e-11));
  }
}

TEST_CASE("the spline passes through its knots, to the domain's last row and column") {
  for (const SplineEnds ends : {SplineEnds::kNotAKnot, SplineEnds::kNatural}) {
    const HeightGrid grid = random_grid(7, 5);
    const BicubicSpline spline(grid, ends);
    for (std::size_t j = 0; j < grid.rows; ++j) {
      for (std::size_t i = 0; i < grid.columns; ++i) {
        const double x = grid.x_origin + static_cast<double>(i) * grid.dx;
        const double y = grid.y_origin + static_cast<double>(j) * grid.dy;
        REQUIRE(spline.sample(x, y).z == Approx(grid.at(i, j)).margin(1e-12));
      }
    }
  }
}

TEST_CASE("the spline's gradient and Hessian are the derivatives of its height") {
  const BicubicSpline spline(random_grid(12, 9));
  core::Random random(5);
  const double h = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const double x = -0.9 + 3.0 * random.uniform();
    const double y = -1.9 + 5.0 * random.uniform();
    const SurfaceSample s = spline.sample(x, y);
    const SurfaceSample east = spline.sample(x + h, y), west = spline.sample(x - h, y);
    const SurfaceSample north = spline.sample(x, y + h), south = spline.sample(x, y - h);
    REQUIRE(s.zx == Approx((east.z - west.z) / (2 * h)).margin(1e-7));
    REQUIRE(s.zy == Approx((north.z - south.z) / (2 * h)).margin(1e-7));
    // Third derivatives jump at cell lines, so these differences carry an error of order h there.
    REQUIRE(s.zxx == Approx((east.zx - west.zx) / (2 * h)).margin(5e-3));
    REQUIRE(s.zxy == Approx((north.zx - south.zx) / (2 * h)).margin(5e-3));
    REQUIRE(s.zyy == Approx((north.zy - south.zy) / (2 * h)).margin(5e-3));
  }
}

TEST_CASE("height, gradient and Hessian are continuous over cell lines") {
  const HeightGrid grid = random_grid(8, 8);
  const BicubicSpline spline(grid);
  core::Random random(6);
  const double e = 1e-12;
  for (std::size_t i = 1; i + 1 < grid.columns; ++i) {
    const double x = grid.x_origin + static_cast<double>(i) * grid.dx;
    const double y = grid.y_origin + 4.9 * random.uniform();
    const SurfaceSample a = spline.sample(x - e, y), b = spline.sample(x + e, y);
    CHECK(a.z == Approx(b.z).margin(1e-10));
    CHECK(a.zx == Approx(b.zx).margin(1e-9));
    CHECK(a.zy == Approx(b.zy).margin(1e-9));
    CHECK(a.zxx == Approx(b.zxx).margin(1e-8));
    CHECK(a.zxy == Approx(b.zxy).margin(1e-8));
    CHECK(a.zyy == Approx(b.zyy).margin(1e-8));
  }
}

TEST_CASE("natural ends have no curvature across the rim") {
  const HeightGrid grid = random_grid(8, 8);
  const BicubicSpline spline(grid, SplineEnds::kNatural);
  const Rectangle d = spline.domain();
  for (double t = 0.05; t < 1.0; t += 0.1) {
    const double x = d.x_min + t * (d.x_max - d.x_min);
    const double y = d.y_min + t * (d.y_max - d.y_min);
    CHECK(spline.sample(d.x_min, y).zxx == Approx(0.0).margin(1e-11));
    CHECK(spline.sample(d.x_max, y).zxx == Approx(0.0).margin(1e-11));
    CHECK(spline.sample(x, d.y_min).zyy == Approx(0.0).margin(1e-11));
    CHECK(spline.sample(x, d.y_max).zyy == Approx(0.0).margin(1e-11));
  }
}

TEST_CASE("the natural spline equals the document's global spline, chapter 5.4, to 1e-12") {
  const tests::CsvTable table = tests::read_reference("surfaces.csv");
  REQUIRE(table.rows.size() == 300);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto name = function_from_text(table.text(row, "surface"));
    REQUIRE(name.has_value());
    const BicubicSpline spline(sample_function(*name, 1.0, static_cast<std::size_t>(table.number(row, "g"))),
                               SplineEnds::kNatural);
    const SurfaceSample s = spline.sample(table.number(row, "x"), table.number(row, "y"));
    INFO("row " << row);
    REQUIRE(s.z == Approx(table.number(row, "spline_z")).margin(1e-12).epsilon(0));
    REQUIRE(s.zx == Approx(table.number(row, "spline_zx")).margin(1e-12).epsilon(0));
    REQUIRE(s.zy == Approx(table.number(row, "spline_zy")).margin(1e-12).epsilon(0));
  }
}

TEST_CASE("halving the spacing divides the spline's height error by 16, up to the rim") {
  const FunctionSurface exact(FunctionName::kWavyPot, 1.0);
  const auto error = [&](std::size_t grid) {
    const BicubicSpline spline(sample_function(FunctionName::kWavyPot, 1.0, grid));
    core::Random random(9);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const double x = 2.0 * random.uniform() - 1.0;
      const double y = 2.0 * random.uniform() - 1.0;
      worst = std::fmax(worst, std::fabs(spline.sample(x, y).z - exact.sample(x, y).z));
    }
    return worst;
  };
  const double order = std::log2(error(20) / error(80)) / 2.0;
  CHECK(order == Approx(4.0).margin(0.3));
}

TEST_CASE("a place too far for any integer is nearest to a cell at the rim, NaN to the first") {
  const BicubicSpline spline(sample_function(FunctionName::kWavyPot, 1.0, 4));
  const auto cell = spline.cell_at(1e300, -1e300);
  CHECK(cell.column == spline.cells().column - 1);
  CHECK(cell.row == 0);
  CHECK(spline.cell_at(std::nan(""), 1e25).column == 0);
  CHECK(spline.cell_at(std::nan(""), 1e25).row == spline.cells().row - 1);
}
