#include "shared/terrain/tile_store.h"

#include <cassert>
#include <utility>

namespace woodlouse::terrain {
namespace {

std::size_t tiles_along(std::size_t knots) {
  assert(knots >= 4);
  return (knots - 1 + BSplineTile::kCells - 1) / BSplineTile::kCells;
}

}  // namespace

TileStore::TileStore(std::shared_ptr<const HeightSource> source, double fill_level, std::size_t max_tiles)
    : source_(std::move(source)),
      fill_level_(fill_level),
      max_tiles_(max_tiles),
      tiles_x_(tiles_along(source_->frame().columns)),
      all_tiles_(tiles_x_ * tiles_along(source_->frame().rows)) {
  assert(max_tiles_ >= 1);
}

TilePointer TileStore::get(std::size_t index) { return find_or_build(index, Purpose::kNeed); }

void TileStore::prepare(std::size_t index) { find_or_build(index, Purpose::kAhead); }

TilePointer TileStore::find_or_build(std::size_t index, Purpose purpose) {
  assert(index < all_tiles_);
  if (TilePointer tile = find(index)) return tile;
  TilePointer tile = build_tile(*source_, index % tiles_x_ * BSplineTile::kCells,
                                index / tiles_x_ * BSplineTile::kCells, fill_level_);
  return keep(index, std::move(tile), purpose);
}

TilePointer TileStore::find(std::size_t index) {
  const core::Lock lock(mutex_);
  const auto place = places_.find(index);
  if (place == places_.end()) return nullptr;
  slots_[place->second].wanted = true;
  return slots_[place->second].tile;
}

TilePointer TileStore::keep(std::size_t index, TilePointer tile, Purpose purpose) {
  TilePointer thrown_out;  // ends after the lock: freeing takes its time too
  const core::Lock lock(mutex_);
  ++counters_.built;
  if (purpose == Purpose::kAhead) ++counters_.prepared;
  if (const auto place = places_.find(index); place != places_.end()) return slots_[place->second].tile;
  if (slots_.size() < max_tiles_) {
    places_.emplace(index, slots_.size());
    slots_.push_back({index, tile, false});
    ++counters_.live;
    return tile;
  }
  while (std::exchange(slots_[hand_].wanted, false)) hand_ = hand_ + 1 == slots_.size() ? 0 : hand_ + 1;
  Slot& slot = slots_[hand_];
  places_.erase(slot.index);
  places_.emplace(index, hand_);
  thrown_out = std::exchange(slot.tile, tile);
  slot.index = index;
  ++counters_.thrown_out;
  hand_ = hand_ + 1 == slots_.size() ? 0 : hand_ + 1;
  return tile;
}

bool TileStore::build_all() {
  if (all_tiles_ > max_tiles_) return false;
  for (std::size_t index = 0; index < all_tiles_; ++index) prepare(index);
  return true;
}

TileStore::Counters TileStore::counters() const {
  const core::Lock lock(mutex_);
  return counters_;
}

}  // namespace woodlouse::terrain
