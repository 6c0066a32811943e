#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/spline_1d.h"
#include "shared/terrain/wrapped_surface.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::terrain;

namespace {

constexpr double kTwoPi = 6.283185307179586;

/// One period of random hills in x and y: the last column and row are the first again.
HeightGrid closed_grid(std::size_t columns, std::size_t rows) {
  HeightGrid grid = tests::random_grid(columns, rows, 8);
  for (std::size_t j = 0; j < rows; ++j) grid.heights[(j + 1) * columns - 1] = grid.heights[j * columns];
  for (std::size_t i = 0; i < columns; ++i) grid.heights[(rows - 1) * columns + i] = grid.heights[i];
  return grid;
}

void require_close(const SurfaceSample& a, const SurfaceSample& b, double margin) {
  CHECK(a.z == Approx(b.z).margin(margin));
  CHECK(a.zx == Approx(b.zx).margin(margin));
  CHECK(a.zy == Approx(b.zy).margin(margin));
  CHECK(a.zxx == Approx(b.zxx).margin(margin));
  CHECK(a.zxy == Approx(b.zxy).margin(margin));
  CHECK(a.zyy == Approx(b.zyy).margin(margin));
}

}  // namespace

TEST_CASE("periodic slopes solve the cyclic equations, from four knots on") {
  for (const std::size_t n : {4u, 5u, 6u, 17u, 100u}) {
    core::Random random(n);
    std::vector<double> z(n), m(n);
    for (double& value : z) value = random.uniform();
    z[n - 1] = z[0];
    const double h = 0.3;
    spline_slopes(z, h, SplineEnds::kPeriodic, m);
    const std::size_t p = n - 1;
    for (std::size_t i = 0; i < p; ++i) {
      const std::size_t next = (i + 1) % p, previous = (i + p - 1) % p;
      INFO(n << " knots, row " << i);
      REQUIRE(m[previous] + 4.0 * m[i] + m[next] == Approx(3.0 * (z[next] - z[previous]) / h).margin(1e-12));
    }
    REQUIRE(m[p] == m[0]);
  }
}

TEST_CASE("a periodic spline is as smooth over the seam as anywhere: height, gradient and Hessian agree") {
  const HeightGrid grid = closed_grid(9, 7);
  const BicubicSpline spline(grid, SplineEnds::kPeriodic);
  const Rectangle d = spline.domain();
  core::Random random(4);
  for (int k = 0; k < 50; ++k) {
    const double x = d.x_min + (d.x_max - d.x_min) * random.uniform();
    const double y = d.y_min + (d.y_max - d.y_min) * random.uniform();
    require_close(spline.sample(d.x_min, y), spline.sample(d.x_max, y), 1e-11);
    require_close(spline.sample(x, d.y_min), spline.sample(x, d.y_max), 1e-11);
  }
}

TEST_CASE("a periodic spline does not know where its seam is") {
  const HeightGrid grid = closed_grid(9, 7);
  HeightGrid turned = grid;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      turned.heights[j * grid.columns + i] = grid.at((i + 3) % (grid.columns - 1), (j + 2) % (grid.rows - 1));
    }
  }
  const WrappedSurface a(BicubicSpline(grid, SplineEnds::kPeriodic));
  const WrappedSurface b(BicubicSpline(turned, SplineEnds::kPeriodic));
  tests::at_random_points(b.period(), 300, 2, [&](double x, double y) {
    require_close(b.sample(x, y), a.sample(x + 3 * grid.dx, y + 2 * grid.dy), 1e-10);
  });
}

TEST_CASE(
    "beyond a seam the surface goes on for the promised cells, over corners too, down to three cells a "
    "period") {
  for (const std::size_t knots : {4u, 9u}) {
    const BicubicSpline spline(closed_grid(knots, knots + 1), SplineEnds::kPeriodic);
    const Rectangle d = spline.domain();
    const double width = d.x_max - d.x_min, height = d.y_max - d.y_min;
    const auto cells = static_cast<double>(BicubicSpline::kBeyondSeam);
    const double dx = width / static_cast<double>(spline.cells().column),
                 dy = height / static_cast<double>(spline.cells().row);
    const WrappedSurface endless(BicubicSpline(closed_grid(knots, knots + 1), SplineEnds::kPeriodic));
    tests::at_random_points(
        {d.x_min - cells * dx, d.y_min - cells * dy, d.x_max + cells * dx, d.y_max + cells * dy}, 500, 7,
        [&](double x, double y) { require_close(spline.sample(x, y), endless.sample(x, y), 1e-10); });
  }
}

TEST_CASE("as many cells on as a period has, the same polynomial holds, bit for bit") {
  const BicubicSpline spline(closed_grid(9, 7), SplineEnds::kPeriodic);
  const BicubicSpline::CellIndex first =
      spline.cell_at(spline.domain().x_min + 0.1, spline.domain().y_min + 0.1);
  const BicubicSpline::CellIndex on{first.column + spline.cells().column, first.row + spline.cells().row};
  const Rectangle here = spline.bounds(first), there = spline.bounds(on);
  for (const double u : {0.0, 0.25, 0.75}) {
    CHECK(spline.sample_in(first, here.x_min + u, here.y_min + u).z ==
          spline.sample_in(on, there.x_min + u, there.y_min + u).z);
  }
}

TEST_CASE("each axis has its own ends: a cylinder is periodic around and exact on cubics along") {
  const auto f = [](double x, double y) { return std::sin(kTwoPi * (x + 1.5) / 4.0) * (y * y * y - y); };
  HeightGrid grid = tests::grid_of(9, 8, f);
  for (std::size_t j = 0; j < grid.rows; ++j) grid.heights[j * 9 + 8] = grid.heights[j * 9];
  const BicubicSpline spline(grid, SplineEnds::kPeriodic, SplineEnds::kNotAKnot);
  const Rectangle d = spline.domain();
  for (double y = d.y_min; y <= d.y_max; y += 0.1) {
    require_close(spline.sample(d.x_min, y), spline.sample(d.x_max, y), 1e-11);
    // Along a knot column the spline is the cubic itself.
    CHECK(spline.sample(0.5, y).z == Approx(f(0.5, y)).margin(1e-12));
    CHECK(spline.sample(0.5, y).zyy == Approx(6.0 * y * std::sin(kTwoPi / 2.0)).margin(1e-10));
    CHECK(spline.sample(-0.5, y).zyy == Approx(6.0 * y * std::sin(kTwoPi / 4.0)).margin(1e-10));
  }
}

TEST_CASE("wrapping takes any turn to its place, hands points of the period on untouched and has no end") {
  const WrappedSurface surface(BicubicSpline(closed_grid(9, 7), SplineEnds::kPeriodic));
  const Rectangle p = surface.period();
  const double width = p.x_max - p.x_min, height = p.y_max - p.y_min;
  tests::at_random_points(p, 200, 3, [&](double x, double y) {
    REQUIRE(surface.sample(x, y).z == surface.inner().sample(x, y).z);
    require_close(surface.sample(x + 3 * width, y - 7 * height), surface.inner().sample(x, y), 1e-10);
    CHECK(std::isfinite(surface.sample(x - 1e9 * width, y).z));
  });
  CHECK(surface.domain().contains(1e300, -1e300));
  CHECK(std::isnan(surface.sample(1e300, 0.0).z));
  CHECK(std::isnan(surface.sample(std::numeric_limits<double>::infinity(), 0.0).z));
  CHECK(std::isnan(surface.sample(0.0, std::numeric_limits<double>::quiet_NaN()).zyy));
  CHECK(std::isfinite(surface.sample(std::nextafter(p.x_min, -1e9), std::nextafter(p.y_max, 1e9)).z));
}

TEST_CASE("one axis may wrap alone, the other keeps its edge") {
  const WrappedSurface surface(BicubicSpline(closed_grid(9, 7), SplineEnds::kPeriodic, SplineEnds::kNatural),
                               WrappedAxes::kX);
  CHECK(surface.domain().contains(1e6, 2.5));
  CHECK_FALSE(surface.domain().contains(0.0, 100.0));
}

TEST_CASE("the seam's mismatch is told for each axis") {
  HeightGrid grid = closed_grid(9, 7);
  grid.heights[3 * 9 + 8] += 0.5;
  grid.heights[6 * 9 + 4] -= 0.25;
  CHECK(seam_mismatch(grid).x == Approx(0.5));
  CHECK(seam_mismatch(grid).y == Approx(0.25));
}
