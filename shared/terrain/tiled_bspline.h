// The global not-a-knot bicubic spline in B-spline form, for big maps: 8 bytes a knot, built tile by tile
// where lice are.
//
// In cell (i, j), u and v in [0, 1] the offsets in knot spacings:
//     z = sum c[i-1+a][j-1+b] w_a(u) w_b(v),  a, b = 0 .. 3
//     6 w(t) = s^3,  4 - 6 t^2 + 3 t^3,  4 - 6 s^2 + 3 s^3,  t^3  with s = 1 - t    (the factors stand in c)
// The coefficients are those of bspline_coefficients.h, along x, then along y, tile by tile (bspline_tile.h).
//
// Continuity: C2; over tile lines to rounding (1e-16 of the heights). Equal to BicubicSpline with not-a-knot
//   ends to 1e-12 of the heights' range. Exact on bicubic polynomials. Orders: height 4, gradient 3,
//   Hessian 2.
// Outside the domain: the edge cell's polynomial goes on.
// Knots without data: NoDataPolicy. Splines ring: next to a hole the surface depends on the filling, by 0.268
// a knot less.
// Memory: 36 KB a visited tile of 64 x 64 cells (8.8 bytes a knot), at most `max_tiles`, and 8 bytes for each
// tile of the map.
// Cost: 16 loads, about 28 ns for z, gradient and Hessian at 21 as at 201 knots a side; two thirds of
//   BicubicSpline's time where its cells are out of the cache (1001 a side, random points). The first visit to a
//   tile 0.15 ms and the reading of its rows, another 0.15 ms from the page cache.
//
// Determinism: a tile depends on its index and the heights alone, never on the order of visits or on what was
//   evicted; so the same bits whichever way the lice walk, and after a restart.
// Threads: sample() is const but builds what it misses: one thread at a time per object. Rooms that share a
//   map take an object each over the same HeightSource (a copy starts with no tiles). After build_all()
//   returned true sample() only reads, and any number of threads may call it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/bspline_tile.h"
#include "shared/terrain/height_source.h"
#include "shared/terrain/surface.h"

namespace woodlouse::terrain {

/// What stands where knots have no data.
enum class NoDataPolicy {
  kHole,  ///< cells with a corner that has no data have no ground: their samples are NaN throughout
  kFill,  ///< ground everywhere, over the filled heights (fill_missing.h)
};

struct TiledBSplineOptions {
  NoDataPolicy no_data = NoDataPolicy::kHole;
  double fill_level = 0.0;       ///< [m], deep inside holes
  std::size_t max_tiles = 4096;  ///< >= 1; 36 KB each. Overflow: the tile that was built first goes.
};

class TiledBSpline {
 public:
  /// REQUIRES at least 4 knots each way, spacings > 0. Reads no height.
  explicit TiledBSpline(std::shared_ptr<const HeightSource> source, const TiledBSplineOptions& options = {});
  /// Over a grid in memory.
  explicit TiledBSpline(HeightGrid grid, const TiledBSplineOptions& options = {});
  TiledBSpline(const TiledBSpline& other);
  TiledBSpline& operator=(const TiledBSpline&) = delete;
  TiledBSpline(TiledBSpline&&) = default;
  TiledBSpline& operator=(TiledBSpline&&) = default;
  ~TiledBSpline() = default;

  [[nodiscard]] SurfaceSample sample(double x, double y) const;
  [[nodiscard]] Rectangle domain() const { return domain_; }
  [[nodiscard]] double cell() const { return dx_ < dy_ ? dx_ : dy_; }

  /// Which polynomial holds at a point, its bounds, and its values wherever asked, as BicubicSpline has them.
  using CellIndex = BicubicSpline::CellIndex;
  [[nodiscard]] CellIndex cell_at(double x, double y) const;
  [[nodiscard]] Rectangle bounds(CellIndex cell) const {
    const double x = domain_.x_min + static_cast<double>(cell.column) * dx_;
    const double y = domain_.y_min + static_cast<double>(cell.row) * dy_;
    return {x, y, x + dx_, y + dy_};
  }
  [[nodiscard]] SurfaceSample sample_in(CellIndex cell, double x, double y) const {
    const long long last_column = static_cast<long long>(last_column_);
    const long long last_row = static_cast<long long>(last_row_);
    return evaluate({cell.column < 0 ? 0 : (cell.column > last_column ? last_column : cell.column),
                     cell.row < 0 ? 0 : (cell.row > last_row ? last_row : cell.row)},
                    x, y);
  }

  /// Whether all four corners of the point's cell have data (the edge's cell for points outside), whatever
  /// the policy.
  [[nodiscard]] bool has_ground(double x, double y) const;

  /// Builds every tile; false, and nothing built, when they are more than max_tiles.
  bool build_all();
  /// Tiles in memory now, and built so far.
  [[nodiscard]] std::size_t tiles() const { return live_; }
  [[nodiscard]] std::uint64_t tiles_built() const { return built_; }

 private:
  [[nodiscard]] SurfaceSample evaluate(CellIndex inside, double x, double y) const;
  [[nodiscard]] const BSplineTile& tile_of(CellIndex inside) const;
  const BSplineTile& build(std::size_t index) const;

  std::shared_ptr<const HeightSource> source_;
  TiledBSplineOptions options_;
  Rectangle domain_;
  double dx_;
  double dy_;
  double inverse_dx_;
  double inverse_dy_;
  double last_column_;  ///< index of the last cell in x
  double last_row_;
  std::size_t tiles_x_;

  // What sample() may change; no result depends on it.
  mutable std::vector<std::unique_ptr<BSplineTile>> tiles_;
  mutable std::vector<std::size_t> oldest_first_;  ///< ring of the tiles in memory, once max_tiles is reached
  mutable std::size_t next_out_ = 0;
  mutable std::size_t live_ = 0;
  mutable std::uint64_t built_ = 0;
};

inline TiledBSpline::CellIndex TiledBSpline::cell_at(double x, double y) const {
  const double column = (x - domain_.x_min) * inverse_dx_;
  const double row = (y - domain_.y_min) * inverse_dy_;
  // Bounded before the conversion, so that no number is too large for it; NaN gives cell 0.
  return {static_cast<long long>(column > 0.0 ? (column < last_column_ ? column : last_column_) : 0.0),
          static_cast<long long>(row > 0.0 ? (row < last_row_ ? row : last_row_) : 0.0)};
}

inline const BSplineTile& TiledBSpline::tile_of(CellIndex inside) const {
  const std::size_t index = static_cast<std::size_t>(inside.row) / BSplineTile::kCells * tiles_x_ +
                            static_cast<std::size_t>(inside.column) / BSplineTile::kCells;
  const std::unique_ptr<BSplineTile>& tile = tiles_[index];
  if (tile == nullptr) [[unlikely]]
    return build(index);
  return *tile;
}

inline SurfaceSample TiledBSpline::sample(double x, double y) const { return evaluate(cell_at(x, y), x, y); }

inline SurfaceSample TiledBSpline::evaluate(CellIndex inside, double x, double y) const {
  const BSplineTile& tile = tile_of(inside);
  const std::size_t i = static_cast<std::size_t>(inside.column) % BSplineTile::kCells;
  const std::size_t j = static_cast<std::size_t>(inside.row) % BSplineTile::kCells;
  if (tile.holes != nullptr) [[unlikely]] {
    if (options_.no_data == NoDataPolicy::kHole && (*tile.holes)[j * BSplineTile::kCells + i]) {
      constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
      return {kNothing, kNothing, kNothing, kNothing, kNothing, kNothing};
    }
  }
  // The derivatives are the splines of the coefficients' differences, of one degree less for each:
  //     6 s' = 3 (s^2 D0 + (1 + 2 s t) D1 + t^2 D2),  6 s'' = 6 (s E0 + t E1),  D = c[a+1] - c[a], E = D[a+1] - D[a].
  struct Weights {
    double s, t, ss, tt, mixed;
    double w[4];
  };
  const auto weights = [](double t) -> Weights {
    const double r = 1.0 - t;
    const double rr = r * r;
    const double tt = t * t;
    return {r,
            t,
            rr,
            tt,
            1.0 + 2.0 * (r * t),
            {rr * r, (3.0 * t - 6.0) * tt + 4.0, (3.0 * r - 6.0) * rr + 4.0, tt * t}};
  };
  const auto value = [](const Weights& w, const double(&c)[4]) {
    return (w.w[0] * c[0] + w.w[1] * c[1]) + (w.w[2] * c[2] + w.w[3] * c[3]);
  };
  const auto slope = [](const Weights& w, const double(&c)[4]) {
    return w.ss * (c[1] - c[0]) + w.mixed * (c[2] - c[1]) + w.tt * (c[3] - c[2]);
  };
  const auto curvature = [](const Weights& w, const double(&c)[4]) {
    return w.s * ((c[2] - c[1]) - (c[1] - c[0])) + w.t * ((c[3] - c[2]) - (c[2] - c[1]));
  };
  const Weights wu = weights((x - domain_.x_min) * inverse_dx_ - static_cast<double>(inside.column));
  const Weights wv = weights((y - domain_.y_min) * inverse_dy_ - static_cast<double>(inside.row));
  const double* c = tile.c.data() + j * BSplineTile::kStride + i;
  // Down the four columns first.
  double z[4];
  double zv[4];
  double zvv[4];
  for (std::size_t a = 0; a < 4; ++a) {
    const double column[4] = {c[a], c[BSplineTile::kStride + a], c[2 * BSplineTile::kStride + a],
                              c[3 * BSplineTile::kStride + a]};
    z[a] = value(wv, column);
    zv[a] = slope(wv, column);
    zvv[a] = curvature(wv, column);
  }
  const double per_x = 3.0 * inverse_dx_;
  const double per_y = 3.0 * inverse_dy_;
  SurfaceSample s;
  s.z = value(wu, z);
  s.zx = slope(wu, z) * per_x;
  s.zy = value(wu, zv) * per_y;
  s.zxx = curvature(wu, z) * (2.0 * inverse_dx_ * per_x);
  s.zxy = slope(wu, zv) * (per_x * per_y);
  s.zyy = value(wu, zvv) * (2.0 * inverse_dy_ * per_y);
  return s;
}

}  // namespace woodlouse::terrain
