#include "shared/terrain/tiled_bspline.h"

#include <cassert>
#include <utility>

namespace woodlouse::terrain {
namespace {

std::size_t tiles_along(std::size_t knots) {
  return (knots - 1 + BSplineTile::kCells - 1) / BSplineTile::kCells;
}

}  // namespace

TiledBSpline::TiledBSpline(std::shared_ptr<const HeightSource> source, const TiledBSplineOptions& options)
    : source_(std::move(source)), options_(options) {
  const GridFrame frame = source_->frame();
  assert(frame.columns >= 4 && frame.rows >= 4 && frame.dx > 0.0 && frame.dy > 0.0 &&
         options_.max_tiles >= 1);
  domain_ = frame.domain();
  dx_ = frame.dx;
  dy_ = frame.dy;
  inverse_dx_ = 1.0 / frame.dx;
  inverse_dy_ = 1.0 / frame.dy;
  last_column_ = static_cast<double>(frame.columns - 2);
  last_row_ = static_cast<double>(frame.rows - 2);
  tiles_x_ = tiles_along(frame.columns);
  tiles_.resize(tiles_x_ * tiles_along(frame.rows));
}

TiledBSpline::TiledBSpline(HeightGrid grid, const TiledBSplineOptions& options)
    : TiledBSpline(std::make_shared<GridHeights>(std::move(grid)), options) {}

TiledBSpline::TiledBSpline(const TiledBSpline& other) : TiledBSpline(other.source_, other.options_) {}

const BSplineTile& TiledBSpline::build(std::size_t index) const {
  if (oldest_first_.size() < options_.max_tiles) {
    oldest_first_.push_back(index);
    ++live_;
  } else {
    tiles_[oldest_first_[next_out_]].reset();
    oldest_first_[next_out_] = index;
    next_out_ = next_out_ + 1 == options_.max_tiles ? 0 : next_out_ + 1;
  }
  tiles_[index] = build_tile(*source_, index % tiles_x_ * BSplineTile::kCells,
                             index / tiles_x_ * BSplineTile::kCells, options_.fill_level);
  ++built_;
  return *tiles_[index];
}

bool TiledBSpline::build_all() {
  if (tiles_.size() > options_.max_tiles) return false;
  for (std::size_t index = 0; index < tiles_.size(); ++index) {
    if (tiles_[index] == nullptr) build(index);
  }
  return true;
}

bool TiledBSpline::has_ground(double x, double y) const {
  const CellIndex cell = cell_at(x, y);
  const BSplineTile& tile = tile_of(cell);
  if (tile.holes == nullptr) return true;
  const std::size_t i = static_cast<std::size_t>(cell.column) % BSplineTile::kCells;
  const std::size_t j = static_cast<std::size_t>(cell.row) % BSplineTile::kCells;
  return !(*tile.holes)[j * BSplineTile::kCells + i];
}

}  // namespace woodlouse::terrain
