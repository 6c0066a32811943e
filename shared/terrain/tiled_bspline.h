// The global not-a-knot bicubic spline in B-spline form (bspline_layout.h), for big maps: 8 bytes a knot,
// built tile by tile where lice are.
//
// Continuity: C2; over tile lines to rounding (1e-16 of the heights). Equal to BicubicSpline with not-a-knot
//   ends to 1e-12 of the heights' range. Exact on bicubic polynomials. Orders: height 4, gradient 3,
//   Hessian 2.
// Outside the domain: the edge cell's polynomial goes on.
// Knots without data: NoDataPolicy. Splines ring: next to a hole the surface depends on the filling, by 0.268
// a knot less.
// Memory: 36 KB a visited tile of 64 x 64 cells (8.8 bytes a knot), bounded by the store (tile_store.h); a
// TiledBSpline keeps at most kPins of them alive besides, until it visits others or goes.
// Cost: 16 loads, about 28 ns for z, gradient and Hessian at 21 as at 201 knots a side; two thirds of
//   BicubicSpline's time where its cells are out of the cache (1001 a side, random points). The first visit
//   to a tile 0.15 ms and the reading of its rows, another 0.15 ms from the page cache.
//
// Determinism: a tile depends on its index and the heights alone, never on the order of visits or on what was
//   thrown out; so the same bits whichever way the lice walk, and after a restart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "shared/terrain/bspline_layout.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/tile_store.h"

namespace woodlouse::terrain {

struct TiledBSplineOptions {
  NoDataPolicy no_data = NoDataPolicy::kHole;
  double fill_level = 0.0;       ///< [m], deep inside holes
  std::size_t max_tiles = 4096;  ///< >= 1; 36 KB each
};

/// A big map's ground, for everybody: any thread may sample it. Copies are the same ground, with the same
/// tiles.
class TiledGround {
 public:
  /// REQUIRES at least 4 knots each way, spacings > 0. Reads no height.
  explicit TiledGround(std::shared_ptr<const HeightSource> source, const TiledBSplineOptions& options = {});

  /// Looks its tile up under the store's lock: for a point now and then. Who samples many takes a
  /// TiledBSpline.
  [[nodiscard]] SurfaceSample sample(double x, double y) const;
  [[nodiscard]] Rectangle domain() const { return layout_.domain(); }
  [[nodiscard]] double cell() const { return layout_.cell(); }
  [[nodiscard]] const BSplineLayout& layout() const { return layout_; }
  /// Not const: which tiles are in memory is nobody's state (tile_store.h).
  [[nodiscard]] TileStore& tiles() const { return *store_; }

 private:
  friend class TiledBSpline;
  BSplineLayout layout_;
  std::shared_ptr<TileStore> store_;
};

/// The same for one thread at a time: remembers the tiles it was in. Made for a tick, or kept.
class TiledBSpline {
 public:
  static constexpr std::size_t kPinsAcross = 16;
  /// Tiles it remembers; one for each place in a block of 16 x 16 tiles. Overflow: the newer of two in one
  /// place.
  static constexpr std::size_t kPins = kPinsAcross * kPinsAcross;

  explicit TiledBSpline(const TiledGround& ground) : ground_(ground) {}
  /// Over a store of its own. REQUIRES at least 4 knots each way, spacings > 0. Reads no height.
  explicit TiledBSpline(std::shared_ptr<const HeightSource> source, const TiledBSplineOptions& options = {})
      : ground_(std::move(source), options) {}
  /// Over a grid in memory.
  explicit TiledBSpline(HeightGrid grid, const TiledBSplineOptions& options = {})
      : TiledBSpline(std::make_shared<GridHeights>(std::move(grid)), options) {}

  [[nodiscard]] SurfaceSample sample(double x, double y) const { return evaluate(cell_at(x, y), x, y); }
  [[nodiscard]] Rectangle domain() const { return ground_.domain(); }
  [[nodiscard]] double cell() const { return ground_.cell(); }

  /// Which polynomial holds at a point, its bounds, and its values wherever asked, as BicubicSpline has them.
  using CellIndex = BSplineLayout::CellIndex;
  [[nodiscard]] CellIndex cell_at(double x, double y) const { return ground_.layout_.cell_at(x, y); }
  [[nodiscard]] Rectangle bounds(CellIndex cell) const { return ground_.layout_.bounds(cell); }
  [[nodiscard]] SurfaceSample sample_in(CellIndex cell, double x, double y) const {
    return evaluate(ground_.layout_.nearest(cell), x, y);
  }

  /// Whether all four corners of the point's cell have data (the edge's cell for points outside), whatever
  /// the policy.
  [[nodiscard]] bool has_ground(double x, double y) const;

  /// Builds every tile; false, and nothing built, when they are more than max_tiles.
  bool build_all() { return ground_.store_->build_all(); }
  /// Tiles in memory now, and built so far.
  [[nodiscard]] std::size_t tiles() const { return ground_.store_->counters().live; }
  [[nodiscard]] std::uint64_t tiles_built() const { return ground_.store_->counters().built; }

 private:
  struct Pin {
    std::size_t index = static_cast<std::size_t>(-1);
    TilePointer tile;
  };

  [[nodiscard]] SurfaceSample evaluate(CellIndex inside, double x, double y) const {
    return ground_.layout_.evaluate(tile_of(inside), inside, x, y);
  }
  [[nodiscard]] const BSplineTile& tile_of(CellIndex inside) const;
  const BSplineTile& fetch(Pin& pin, std::size_t index) const;

  TiledGround ground_;
  mutable std::array<Pin, kPins> pins_;  ///< what sample() may change; no result depends on it
};

inline const BSplineTile& TiledBSpline::tile_of(CellIndex inside) const {
  const std::size_t row = static_cast<std::size_t>(inside.row) / BSplineTile::kCells;
  const std::size_t column = static_cast<std::size_t>(inside.column) / BSplineTile::kCells;
  const std::size_t index = ground_.layout_.tile_of(inside);
  Pin& pin = pins_[row % kPinsAcross * kPinsAcross + column % kPinsAcross];
  if (pin.index != index) [[unlikely]]
    return fetch(pin, index);
  return *pin.tile;
}

}  // namespace woodlouse::terrain
