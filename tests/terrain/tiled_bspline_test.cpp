#include "shared/terrain/tiled_bspline.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <thread>
#include <vector>

#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/bspline_coefficients.h"
#include "shared/terrain/spline_1d.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::terrain;

namespace {

bool same_bits(const SurfaceSample& a, const SurfaceSample& b) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  return bits(a.z) == bits(b.z) && bits(a.zx) == bits(b.zx) && bits(a.zy) == bits(b.zy) &&
         bits(a.zxx) == bits(b.zxx) && bits(a.zxy) == bits(b.zxy) && bits(a.zyy) == bits(b.zyy);
}

/// Gentle waves on 10,001 x 10,001 knots a metre apart, computed when they are read.
class CountedWaves final : public HeightSource {
 public:
  static double height(double x, double y) { return std::sin(0.02 * x) * std::cos(0.03 * y); }
  [[nodiscard]] GridFrame frame() const override { return {10001, 10001, 0.0, 0.0, 1.0, 1.0}; }
  void read(std::size_t column, std::size_t row, std::span<double> out) const override {
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = height(static_cast<double>(column + k), static_cast<double>(row));
    }
    heights_read += out.size();
  }

  mutable std::size_t heights_read = 0;
};

std::vector<std::pair<double, double>> points_of(const Rectangle& r, int count, std::uint64_t seed) {
  std::vector<std::pair<double, double>> points;
  tests::at_random_points(r, count, seed, [&](double x, double y) { points.emplace_back(x, y); });
  return points;
}

}  // namespace

TEST_CASE(
    "B-spline coefficients give the values and the not-a-knot slopes at the knots, from four knots on") {
  for (const std::size_t n : {4u, 5u, 6u, 7u, 40u}) {
    core::Random random(n);
    std::vector<double> z(n), slopes(n), c(n + 2);
    for (double& value : z) value = random.uniform();
    bspline_coefficients(z, 1, c);
    spline_slopes(z, 1.0, SplineEnds::kNotAKnot, slopes);
    for (std::size_t k = 0; k < n; ++k) {
      INFO(n << " knots, knot " << k);
      CHECK((c[k] + 4 * c[k + 1] + c[k + 2]) / 6 == Approx(z[k]).margin(1e-13));
      CHECK((c[k + 2] - c[k]) / 2 == Approx(slopes[k]).margin(1e-12));
    }
  }
}

TEST_CASE("lines solved side by side are the lines solved alone, bit for bit") {
  core::Random random(1);
  const std::size_t n = 19, lanes = 7;
  std::vector<double> z(n * lanes), c((n + 2) * lanes), line(n), alone(n + 2);
  for (double& value : z) value = random.uniform();
  bspline_coefficients(z, lanes, c);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    for (std::size_t k = 0; k < n; ++k) line[k] = z[k * lanes + lane];
    bspline_coefficients(line, 1, alone);
    for (std::size_t k = 0; k < n + 2; ++k) REQUIRE(c[k * lanes + lane] == alone[k]);
  }
}

TEST_CASE(
    "the tiled B-spline is the global not-a-knot spline to 1e-12 of the heights' range, on rough ground") {
  constexpr std::size_t kSizes[][2] = {{4, 5}, {64, 66}, {65, 130}, {201, 150}, {333, 65}};
  for (const auto& size : kSizes) {
    const std::size_t columns = size[0], rows = size[1];
    for (const double level : {0.0, 3.0}) {
      HeightGrid grid = tests::random_grid(columns, rows, 12);
      for (double& z : grid.heights) z += level;
      const BicubicSpline global(grid);
      const TiledBSpline tiled(grid);
      const auto compare = [&](double x, double y) {
        const SurfaceSample a = tiled.sample(x, y), b = global.sample(x, y);
        INFO(columns << " x " << rows << " at " << x << ", " << y);
        REQUIRE(a.z == Approx(b.z).margin(1e-12).epsilon(0));
        REQUIRE(a.zx == Approx(b.zx).margin(1e-12 / 0.25).epsilon(0));
        REQUIRE(a.zy == Approx(b.zy).margin(1e-12 / 0.25).epsilon(0));
        REQUIRE(a.zxx == Approx(b.zxx).margin(4e-12 / 0.0625).epsilon(0));
        REQUIRE(a.zxy == Approx(b.zxy).margin(4e-12 / 0.0625).epsilon(0));
        REQUIRE(a.zyy == Approx(b.zyy).margin(4e-12 / 0.0625).epsilon(0));
      };
      const Rectangle d = grid.domain();
      tests::at_random_points(d, 2000, 5, compare);
      tests::at_random_points({d.x_min - 0.1, d.y_min - 0.05, d.x_max + 0.1, d.y_max + 0.05}, 500, 6,
                              compare);
      compare(d.x_min, d.y_min);
      compare(d.x_max, d.y_max);
    }
  }
}

TEST_CASE("the tiled B-spline is exact on bicubic polynomials, Hessian included") {
  const auto p = [](double x) { return 0.3 + x * (-0.7 + x * (0.11 + x * 0.05)); };
  const auto dp = [](double x) { return -0.7 + x * (0.22 + x * 0.15); };
  const auto ddp = [](double x) { return 0.22 + 0.3 * x; };
  const TiledBSpline surface(tests::grid_of(9, 6, [&](double x, double y) { return p(x) * p(y); }));
  tests::at_random_points(surface.domain(), 1000, 3, [&](double x, double y) {
    const SurfaceSample s = surface.sample(x, y);
    REQUIRE(s.z == Approx(p(x) * p(y)).margin(1e-12));
    REQUIRE(s.zx == Approx(dp(x) * p(y)).margin(1e-11));
    REQUIRE(s.zxx == Approx(ddp(x) * p(y)).margin(1e-10));
    REQUIRE(s.zxy == Approx(dp(x) * dp(y)).margin(1e-10));
    REQUIRE(s.zyy == Approx(p(x) * ddp(y)).margin(1e-10));
  });
}

TEST_CASE("over a tile line nothing jumps by more than rounding") {
  const HeightGrid grid = tests::random_grid(140, 140, 3);
  const TiledBSpline surface(grid);
  for (const std::size_t line : {64u, 128u}) {
    const double x = grid.x_origin + static_cast<double>(line) * grid.dx;
    for (double y = 2.3; y < 30.0; y += 0.37) {
      const SurfaceSample a = surface.sample(std::nextafter(x, -1e9), y), b = surface.sample(x, y);
      CHECK(a.z == Approx(b.z).margin(1e-13));
      CHECK(a.zx == Approx(b.zx).margin(1e-12));
      CHECK(a.zxx == Approx(b.zxx).margin(1e-10));
      CHECK(a.zyy == Approx(b.zyy).margin(1e-10));
    }
  }
}

TEST_CASE(
    "the order of visits changes no bit, nor does what was thrown out in between, nor building all tiles at "
    "once") {
  const HeightGrid grid = tests::random_grid(300, 270, 21);
  const auto source = std::make_shared<GridHeights>(grid);
  auto points = points_of(grid.domain(), 3000, 8);
  const TiledBSpline forwards(source);
  std::vector<SurfaceSample> expected;
  for (const auto& [x, y] : points) expected.push_back(forwards.sample(x, y));
  CHECK(forwards.tiles() == 25);

  TiledBSpline whole(source);
  REQUIRE(whole.build_all());
  TiledBSplineOptions narrow;
  narrow.max_tiles = 2;
  const TiledGround forgetful(source, narrow);
  const TiledBSpline backwards(source);
  for (std::size_t k = points.size(); k-- > 0;) {
    const auto [x, y] = points[k];
    REQUIRE(same_bits(backwards.sample(x, y), expected[k]));
    REQUIRE(same_bits(forgetful.sample(x, y), expected[k]));
    REQUIRE(same_bits(whole.sample(x, y), expected[k]));
  }
  const TileStore::Counters counters = forgetful.tiles().counters();
  CHECK(counters.live == 2);
  CHECK(counters.built > 100);
  CHECK(counters.thrown_out == counters.built - 2);
}

TEST_CASE("a ground that several threads sample and prepare at once gives the bits it gives one alone") {
  const HeightGrid grid = tests::random_grid(300, 270, 21);
  const auto source = std::make_shared<GridHeights>(grid);
  const TiledBSpline alone(source);
  TiledBSplineOptions narrow;
  narrow.max_tiles = 5;
  const TiledGround shared(source, narrow);
  std::atomic<int> wrong{0};
  std::vector<std::vector<SurfaceSample>> expected(3);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    for (const auto& [x, y] : points_of(grid.domain(), 600, seed))
      expected[seed].push_back(alone.sample(x, y));
  }
  std::vector<std::thread> threads;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    threads.emplace_back([&, seed] {
      const TiledBSpline own(shared);
      const auto points = points_of(grid.domain(), 600, seed);
      for (std::size_t k = 0; k < points.size(); ++k) {
        const auto [x, y] = points[k];
        if (!same_bits(shared.sample(x, y), expected[seed][k]) ||
            !same_bits(own.sample(x, y), expected[seed][k]))
          ++wrong;
      }
    });
  }
  threads.emplace_back([&] {
    for (std::size_t tile = 0; tile < 200; ++tile)
      shared.tiles().prepare(tile * 7 % shared.tiles().all_tiles());
  });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
  CHECK(shared.tiles().counters().live == 5);
}

TEST_CASE("a tile that is asked for again and again stays where others come and go") {
  const auto source = std::make_shared<GridHeights>(tests::random_grid(300, 270, 21));
  TileStore store(source, 0.0, 3);
  const TilePointer kept = store.get(0);
  for (std::size_t tile = 1; tile < 25; ++tile) {
    static_cast<void>(store.get(tile));
    REQUIRE(store.get(0) == kept);
  }
  CHECK(store.counters().built == 25);
  store.prepare(0);
  store.prepare(1);
  CHECK(store.counters().prepared == 1);
}

TEST_CASE(
    "only visited tiles are built, at most max_tiles are kept, and build_all refuses what would not fit") {
  const HeightGrid grid = tests::random_grid(300, 270, 21);
  TiledBSplineOptions options;
  options.max_tiles = 3;
  TiledBSpline surface(grid, options);
  CHECK(surface.tiles() == 0);
  CHECK_FALSE(surface.build_all());
  CHECK(surface.tiles() == 0);
  static_cast<void>(surface.sample(grid.x_origin, grid.y_origin));
  static_cast<void>(surface.sample(grid.x_origin + 63.9 * grid.dx, grid.y_origin));
  CHECK(surface.tiles_built() == 1);
  for (int k = 0; k < 5; ++k)
    static_cast<void>(surface.sample(grid.x_origin + 64.5 * k * grid.dx, grid.y_origin));
  CHECK(surface.tiles_built() == 5);
  CHECK(surface.tiles() == 3);
}

TEST_CASE("a cell's polynomial goes on where a neighbour's begins, and is the sample within its bounds") {
  const HeightGrid grid = tests::random_grid(140, 70, 3);
  const TiledBSpline tiled(grid);
  const BicubicSpline global(grid);
  const Rectangle d = grid.domain();
  tests::at_random_points(
      {d.x_min - 1, d.y_min - 1, d.x_max + 1, d.y_max + 1}, 500, 9, [&](double x, double y) {
        const TiledBSpline::CellIndex cell = tiled.cell_at(x, y);
        REQUIRE(same_bits(tiled.sample_in(cell, x, y), tiled.sample(x, y)));
        if (d.contains(x, y)) REQUIRE(tiled.bounds(cell).contains(x, y));
        const TiledBSpline::CellIndex next{cell.column + 1, cell.row - 1};
        REQUIRE(tiled.sample_in(next, x, y).z == Approx(global.sample_in(next, x, y).z).margin(1e-9));
        REQUIRE(tiled.sample_in(next, x, y).zxy == Approx(global.sample_in(next, x, y).zxy).margin(1e-8));
      });
}

TEST_CASE(
    "a map of 10,001 x 10,001 knots opens without reading it, only what is visited is read, within 200 MB") {
  const auto source = std::make_shared<CountedWaves>();
  const TiledBSpline surface{std::shared_ptr<const HeightSource>(source)};
  CHECK(source->heights_read == 0);
  tests::at_random_points(surface.domain(), 100, 5, [&](double x, double y) {
    REQUIRE(surface.sample(x, y).z == Approx(CountedWaves::height(x, y)).margin(1e-6));
  });
  CHECK(surface.tiles() <= 100);
  CHECK(source->heights_read <= 100 * 125 * 125);
  CHECK(TiledBSplineOptions{}.max_tiles * sizeof(BSplineTile) + 157 * 157 * sizeof(void*) < 200'000'000);
}

TEST_CASE("a change of one height reaches no bit of a tile further than its margin") {
  HeightGrid grid = tests::random_grid(300, 10, 21);
  const TiledBSpline before(grid);
  grid.heights[5 * 300 + 10] += 1.0;
  const TiledBSpline after(grid);
  const double far = grid.x_origin + 130.0 * grid.dx;
  CHECK(same_bits(before.sample(far, 3.0), after.sample(far, 3.0)));
  CHECK_FALSE(same_bits(before.sample(grid.x_origin + 20 * grid.dx, 3.0),
                        after.sample(grid.x_origin + 20 * grid.dx, 3.0)));
}
