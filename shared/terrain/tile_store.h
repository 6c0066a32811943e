// The tiles of one big map that are in memory, shared by everybody who samples it.
//
// Which tiles there are never shows in a result: a tile is a function of its index and the heights alone
// (bspline_tile.h), so it is the same whenever, in whichever order and by whomever it is built, and built
// anew after it was thrown out.
//
// Memory: at most max_tiles, 36 KB each. Overflow: a tile that nobody asked for since the last time around
// goes (second chance, a clock). Where lice are in more tiles than that at once, tiles are built anew every
// tick, 0.3 ms each from the page cache: slow, and nothing else. Who holds a tile that went keeps it alive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "shared/core/lock.h"
#include "shared/terrain/bspline_tile.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::terrain {

using TilePointer = std::shared_ptr<const BSplineTile>;

/// Any thread, every function; a lock is held for a look-up, never while a tile is built.
class TileStore {
 public:
  /// fill_level [m]: see fill_missing.h. REQUIRES at least 4 knots each way, max_tiles >= 1. Reads no height.
  TileStore(std::shared_ptr<const HeightSource> source, double fill_level, std::size_t max_tiles);

  /// The tile, built now if it is not there. Two who miss the same tile both build it and share one of them.
  /// REQUIRES index < all_tiles().
  [[nodiscard]] TilePointer get(std::size_t index);
  /// get() ahead of need, by whoever may wait: the tile is counted as prepared.
  void prepare(std::size_t index);
  /// Builds every tile; false, and nothing built, when they are more than max_tiles.
  bool build_all();

  [[nodiscard]] const HeightSource& source() const { return *source_; }
  [[nodiscard]] std::size_t max_tiles() const { return max_tiles_; }
  /// Of the whole map.
  [[nodiscard]] std::size_t all_tiles() const { return all_tiles_; }

  struct Counters {
    std::size_t live = 0;          ///< in memory now
    std::uint64_t built = 0;       ///< ever, prepared ones included
    std::uint64_t prepared = 0;    ///< of them, built ahead of need
    std::uint64_t thrown_out = 0;  ///< made room for others
  };
  [[nodiscard]] Counters counters() const;

 private:
  enum class Purpose { kNeed, kAhead };
  struct Slot {
    std::size_t index;
    TilePointer tile;
    bool wanted;  ///< again, since it was built or the hand came by
  };

  TilePointer find_or_build(std::size_t index, Purpose purpose);
  TilePointer find(std::size_t index);
  TilePointer keep(std::size_t index, TilePointer tile, Purpose purpose);

  const std::shared_ptr<const HeightSource> source_;
  const double fill_level_;
  const std::size_t max_tiles_;
  const std::size_t tiles_x_;
  const std::size_t all_tiles_;

  mutable core::Mutex mutex_;                            ///< guards what follows
  std::unordered_map<std::size_t, std::size_t> places_;  ///< tile to slot; never iterated
  std::vector<Slot> slots_;
  std::size_t hand_ = 0;
  Counters counters_;
};

}  // namespace woodlouse::terrain
