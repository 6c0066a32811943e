#include "shared/terrain/tiled_bspline.h"

#include <utility>

namespace woodlouse::terrain {

TiledGround::TiledGround(std::shared_ptr<const HeightSource> source, const TiledBSplineOptions& options)
    : layout_(source->frame(), options.no_data),
      store_(std::make_shared<TileStore>(std::move(source), options.fill_level, options.max_tiles)) {}

SurfaceSample TiledGround::sample(double x, double y) const {
  const BSplineLayout::CellIndex cell = layout_.cell_at(x, y);
  return layout_.evaluate(*store_->get(layout_.tile_of(cell)), cell, x, y);
}

bool TiledBSpline::has_ground(double x, double y) const {
  const CellIndex cell = cell_at(x, y);
  return BSplineLayout::has_ground(tile_of(cell), cell);
}

const BSplineTile& TiledBSpline::fetch(Pin& pin, std::size_t index) const {
  pin.tile = ground_.store_->get(index);
  pin.index = index;
  return *pin.tile;
}

}  // namespace woodlouse::terrain
