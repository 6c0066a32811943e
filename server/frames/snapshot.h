// A room's lice as they were at one tick, copied, so that others may look at them while the game goes on.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "server/frames/frame_encoder.h"
#include "server/frames/shared_value.h"
#include "shared/state/louse.h"

namespace woodlouse::server {

/// The terrain outlives it.
struct Snapshot {
  std::uint64_t tick = 0;
  std::uint64_t index = 0;  ///< of the frame (frame.h)
  std::vector<state::Louse> lice;
  const terrain::Terrain* terrain = nullptr;
  std::uint64_t hash = 0;
  state::HashLink link;
  std::optional<GameScene> game;
  bool wraps = false;

  [[nodiscard]] Scene scene() const { return {tick, index, lice, *terrain, hash, link, game, wraps}; }
};

using SharedSnapshot = SharedValue<Snapshot>;

inline SharedSnapshot take_snapshot(SharedPool<Snapshot>& pool, const Scene& scene) {
  const auto fill = [&scene](Snapshot& taken) {
    taken.tick = scene.tick;
    taken.index = scene.index;
    taken.lice.assign(scene.lice.begin(), scene.lice.end());
    taken.terrain = &scene.terrain;
    taken.hash = scene.hash;
    taken.link = scene.link;
    taken.game = scene.game;
    taken.wraps = scene.wraps;
  };
  return pool.make(fill, [](const Snapshot&) { return true; });
}

}  // namespace woodlouse::server
