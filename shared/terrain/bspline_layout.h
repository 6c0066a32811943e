// The global not-a-knot bicubic spline in B-spline form, for big maps: how a point finds its tile and cell,
// and what the spline is there.
//
// In cell (i, j), u and v in [0, 1] the offsets in knot spacings:
//     z = sum c[i-1+a][j-1+b] w_a(u) w_b(v),  a, b = 0 .. 3
//     6 w(t) = s^3,  4 - 6 t^2 + 3 t^3,  4 - 6 s^2 + 3 s^3,  t^3  with s = 1 - t    (the factors stand in c)
// The coefficients are those of bspline_coefficients.h, along x, then along y, tile by tile (bspline_tile.h).
#pragma once

#include <cassert>
#include <cstddef>
#include <limits>

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

/// Immutable; any thread.
class BSplineLayout {
 public:
  using CellIndex = BicubicSpline::CellIndex;

  /// REQUIRES at least 4 knots each way, spacings > 0.
  BSplineLayout(const GridFrame& frame, NoDataPolicy no_data)
      : domain_(frame.domain()),
        dx_(frame.dx),
        dy_(frame.dy),
        inverse_dx_(1.0 / frame.dx),
        inverse_dy_(1.0 / frame.dy),
        last_column_(static_cast<double>(frame.columns - 2)),
        last_row_(static_cast<double>(frame.rows - 2)),
        tiles_x_((frame.columns - 1 + BSplineTile::kCells - 1) / BSplineTile::kCells),
        no_data_(no_data) {
    assert(frame.columns >= 4 && frame.rows >= 4 && frame.dx > 0.0 && frame.dy > 0.0);
  }

  [[nodiscard]] const Rectangle& domain() const { return domain_; }
  [[nodiscard]] double cell() const { return dx_ < dy_ ? dx_ : dy_; }
  /// The cell at a point, the nearest one for points outside.
  [[nodiscard]] CellIndex cell_at(double x, double y) const {
    const double column = (x - domain_.x_min) * inverse_dx_;
    const double row = (y - domain_.y_min) * inverse_dy_;
    // Bounded before the conversion, so that no number is too large for it; NaN gives cell 0.
    return {static_cast<long long>(column > 0.0 ? (column < last_column_ ? column : last_column_) : 0.0),
            static_cast<long long>(row > 0.0 ? (row < last_row_ ? row : last_row_) : 0.0)};
  }
  /// The cell, or the nearest one there is.
  [[nodiscard]] CellIndex nearest(CellIndex cell) const {
    const long long last_column = static_cast<long long>(last_column_);
    const long long last_row = static_cast<long long>(last_row_);
    return {cell.column < 0 ? 0 : (cell.column > last_column ? last_column : cell.column),
            cell.row < 0 ? 0 : (cell.row > last_row ? last_row : cell.row)};
  }
  [[nodiscard]] Rectangle bounds(CellIndex cell) const {
    const double x = domain_.x_min + static_cast<double>(cell.column) * dx_;
    const double y = domain_.y_min + static_cast<double>(cell.row) * dy_;
    return {x, y, x + dx_, y + dy_};
  }
  /// The index of the tile that holds a cell of the map.
  [[nodiscard]] std::size_t tile_of(CellIndex inside) const {
    return static_cast<std::size_t>(inside.row) / BSplineTile::kCells * tiles_x_ +
           static_cast<std::size_t>(inside.column) / BSplineTile::kCells;
  }
  /// Whether all four corners of a cell have data, whatever the policy. `tile`: the cell's own.
  [[nodiscard]] static bool has_ground(const BSplineTile& tile, CellIndex inside) {
    return tile.holes == nullptr ||
           !(*tile.holes)[static_cast<std::size_t>(inside.row) % BSplineTile::kCells * BSplineTile::kCells +
                          static_cast<std::size_t>(inside.column) % BSplineTile::kCells];
  }
  /// The polynomial of a cell of the map, wherever asked. `tile`: the cell's own.
  [[nodiscard]] SurfaceSample evaluate(const BSplineTile& tile, CellIndex inside, double x, double y) const;

 private:
  Rectangle domain_;
  double dx_;
  double dy_;
  double inverse_dx_;
  double inverse_dy_;
  double last_column_;  ///< index of the last cell in x
  double last_row_;
  std::size_t tiles_x_;
  NoDataPolicy no_data_;
};

inline SurfaceSample BSplineLayout::evaluate(const BSplineTile& tile, CellIndex inside, double x,
                                             double y) const {
  const std::size_t i = static_cast<std::size_t>(inside.column) % BSplineTile::kCells;
  const std::size_t j = static_cast<std::size_t>(inside.row) % BSplineTile::kCells;
  if (tile.holes != nullptr) [[unlikely]] {
    if (no_data_ == NoDataPolicy::kHole && !has_ground(tile, inside)) {
      constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
      return {kNothing, kNothing, kNothing, kNothing, kNothing, kNothing};
    }
  }
  // The derivatives are the splines of the coefficients' differences, of one degree less for each:
  //     6 s' = 3 (s^2 D0 + (1 + 2 s t) D1 + t^2 D2),  6 s'' = 6 (s E0 + t E1),  D = c[a+1] - c[a], E = D[a+1]
  //     - D[a].
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
