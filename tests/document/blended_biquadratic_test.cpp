#include "shared/document/blended_biquadratic.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "shared/terrain/function_surface.h"
#include "tests/support/csv.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::document;
using namespace woodlouse::terrain;

TEST_CASE("the blended biquadratic equals the document's, chapter 4.3, to 1e-12, its gradient included") {
  const tests::CsvTable table = tests::read_reference("surfaces.csv");
  REQUIRE(table.rows.size() == 300);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto name = function_from_text(table.text(row, "surface"));
    REQUIRE(name.has_value());
    const HeightGrid grid = sample_function(*name, 1.0, static_cast<std::size_t>(table.number(row, "g")));
    const double x = table.number(row, "x"), y = table.number(row, "y");
    const SurfaceSample s = BlendedDocument(grid).sample(x, y);
    INFO("row " << row);
    REQUIRE(s.z == Approx(table.number(row, "blend_z")).margin(1e-12).epsilon(0));
    REQUIRE(s.zx == Approx(table.number(row, "blend_zx")).margin(1e-12).epsilon(0));
    REQUIRE(s.zy == Approx(table.number(row, "blend_zy")).margin(1e-12).epsilon(0));
    REQUIRE(Blended(grid).sample(x, y).z == s.z);
    REQUIRE(BlendedDifferenced(grid).sample(x, y).z == s.z);
  }
}

TEST_CASE(
    "the consistent gradient is the derivative of the blended height, up to the rim, the document's is not") {
  const HeightGrid grid = tests::random_grid(12, 9, 5);
  const Blended surface(grid);
  const BlendedDocument document(grid);
  const double h = 1e-5;
  int tried = 0;
  double worst_document = 0.0;
  tests::at_random_points(surface.domain(), 2000, 7, [&](double x, double y) {
    const auto [column, row] = tests::in_knots(grid, x, y);
    if (tests::to_half(column) < 1e-3 || tests::to_half(row) < 1e-3) return;
    ++tried;
    const SurfaceSample s = surface.sample(x, y);
    const double zx = (surface.sample(x + h, y).z - surface.sample(x - h, y).z) / (2 * h);
    const double zy = (surface.sample(x, y + h).z - surface.sample(x, y - h).z) / (2 * h);
    REQUIRE(s.zx == Approx(zx).margin(1e-7));
    REQUIRE(s.zy == Approx(zy).margin(1e-7));
    worst_document = std::fmax(worst_document, std::fabs(document.sample(x, y).zx - zx));
  });
  CHECK(tried > 1800);
  CHECK(worst_document > 0.01);
}

TEST_CASE(
    "the document's blended gradient is off by up to 0.009 on wavy_pot and 0.028 on volcano at h = 0.1") {
  const auto worst = [](FunctionName name) {
    const HeightGrid grid = sample_function(name, 1.0, 10);
    const Blended consistent(grid);
    const BlendedDocument document(grid);
    double result = 0.0;
    tests::at_random_points({-0.8, -0.8, 0.8, 0.8}, 20000, 1, [&](double x, double y) {
      const SurfaceSample a = consistent.sample(x, y), b = document.sample(x, y);
      result = std::fmax(result, std::hypot(a.zx - b.zx, a.zy - b.zy));
    });
    return result;
  };
  CHECK(worst(FunctionName::kWavyPot) == Approx(0.0088).epsilon(0.2));
  CHECK(worst(FunctionName::kVolcano) == Approx(0.028).epsilon(0.2));
}

TEST_CASE("the differenced gradient is the consistent one to the square of its step") {
  const HeightGrid grid = tests::smooth_grid(12, 9);
  const Blended consistent(grid);
  const BlendedDifferenced differenced(grid);
  tests::at_random_points(consistent.domain(), 1000, 7, [&](double x, double y) {
    const auto [column, row] = tests::in_knots(grid, x, y);
    if (tests::to_half(column) < 2e-3 || tests::to_half(row) < 2e-3) return;
    const SurfaceSample a = consistent.sample(x, y), b = differenced.sample(x, y);
    REQUIRE(a.zx == Approx(b.zx).margin(1e-6));
    REQUIRE(a.zy == Approx(b.zy).margin(1e-6));
  });
}

TEST_CASE("all three blends are exact on biquadratic polynomials, up to the rim") {
  const auto p = [](double x) { return 0.3 - 0.7 * x + 0.4 * x * x; };
  const auto dp = [](double x) { return -0.7 + 0.8 * x; };
  const auto q = [](double y) { return -1.1 + 0.2 * y - 0.5 * y * y; };
  const auto dq = [](double y) { return 0.2 - 1.0 * y; };
  const HeightGrid grid = tests::grid_of(7, 5, [&](double x, double y) { return p(x) * q(y); });
  const auto check = [&](const auto& surface, double margin) {
    tests::at_random_points(surface.domain(), 500, 1, [&](double x, double y) {
      const SurfaceSample s = surface.sample(x, y);
      REQUIRE(s.z == Approx(p(x) * q(y)).margin(1e-12));
      REQUIRE(s.zx == Approx(dp(x) * q(y)).margin(margin));
      REQUIRE(s.zy == Approx(p(x) * dq(y)).margin(margin));
    });
  };
  check(Blended(grid), 1e-11);
  check(BlendedDocument(grid), 1e-11);
  check(BlendedDifferenced(grid), 1e-9);
}

TEST_CASE(
    "along one axis the blend is the Catmull-Rom cubic: C1 halfway and at knots, the rim's first cell too") {
  core::Random random(3);
  double z[9];
  for (double& value : z) value = random.uniform();
  const HeightGrid grid = tests::grid_of(
      9, 5, [&](double x, double) { return z[static_cast<int>(std::lround((x + 1.5) / 0.5))]; });
  const Blended surface(grid);
  for (int half = 1; half < 16; ++half) {
    const double x = -1.5 + 0.25 * half;
    const SurfaceSample west = surface.sample(x - 1e-10, 2.7), east = surface.sample(x + 1e-10, 2.7);
    INFO("at " << 0.5 * half << " knots");
    CHECK(west.z == Approx(east.z).margin(1e-8));
    CHECK(west.zx == Approx(east.zx).margin(1e-7));
  }
}

TEST_CASE("halfway between knots the blended height's jump falls with the sixth power of the spacing") {
  const auto jump = [](std::size_t grid) {
    const Blended surface(sample_function(FunctionName::kHills, 1.0, grid));
    const double h = 1.0 / static_cast<double>(grid);
    double worst = 0.0;
    for (double y = -0.49; y < 0.5; y += 0.01) {
      const double x = 0.5 * h;
      worst = std::fmax(worst, std::fabs(surface.sample(x + 1e-13, y).z - surface.sample(x - 1e-13, y).z));
    }
    return worst;
  };
  const double order = std::log2(jump(4) / jump(8));
  CHECK(order == Approx(6.0).margin(0.6));
}
