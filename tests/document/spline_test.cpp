#include "shared/document/spline.h"

#include <catch2/catch.hpp>

#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/function_surface.h"
#include "tests/support/csv.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

TEST_CASE("the document's evaluation gives the document's numbers, chapter 5.4, to 1e-12") {
  const tests::CsvTable table = tests::read_reference("surfaces.csv");
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto name = function_from_text(table.text(row, "surface"));
    REQUIRE(name.has_value());
    const Spline surface(sample_function(*name, 1.0, static_cast<std::size_t>(table.number(row, "g"))));
    const SurfaceSample s = surface.sample(table.number(row, "x"), table.number(row, "y"));
    INFO("row " << row);
    REQUIRE(s.z == Approx(table.number(row, "spline_z")).margin(1e-12).epsilon(0));
    REQUIRE(s.zx == Approx(table.number(row, "spline_zx")).margin(1e-12).epsilon(0));
    REQUIRE(s.zy == Approx(table.number(row, "spline_zy")).margin(1e-12).epsilon(0));
  }
}

TEST_CASE(
    "the document's evaluation and the natural bicubic spline are one surface, on any grid, at knots and "
    "beyond the rim") {
  constexpr std::size_t kSizes[][2] = {{5, 9}, {21, 5}, {40, 33}};
  for (const auto& size : kSizes) {
    const std::size_t columns = size[0], rows = size[1];
    const HeightGrid grid = tests::random_grid(columns, rows, 2);
    const Spline document(grid);
    const BicubicSpline spline(grid, SplineEnds::kNatural);
    const auto compare = [&](double x, double y) {
      const SurfaceSample a = document.sample(x, y), b = spline.sample(x, y);
      REQUIRE(a.z == Approx(b.z).margin(1e-12).epsilon(0));
      REQUIRE(a.zx == Approx(b.zx).margin(1e-12).epsilon(1e-12));
      REQUIRE(a.zy == Approx(b.zy).margin(1e-12).epsilon(1e-12));
    };
    const Rectangle d = grid.domain();
    tests::at_random_points({d.x_min - 0.1, d.y_min - 0.05, d.x_max + 0.1, d.y_max + 0.05}, 500, 9, compare);
    for (std::size_t i = 0; i < columns; ++i) compare(d.x_min + static_cast<double>(i) * grid.dx, d.y_max);
  }
}
