// Builds the tiles of a big map around lice before they get there, on a thread of its own, so that a tick
// seldom waits for one (0.3 ms from the page cache, as long as 124 reads take from a disk). What a tick
// computes is the same whether a tile was there or not (terrain/tile_store.h).
//
// Each tick looks at a sixth of the lice, so that all are seen ten times a second: their tiles within
// kAheadSeconds at their speed and the largest push, at most one tile's side away. Bounded: one batch of
// tiles at work; while it is, looks are left out. A batch has at most half as many tiles as the map keeps;
// what is over that the ticks build themselves.
#pragma once

#include <spdlog/logger.h>
#include <atomic>
#include <boost/asio/thread_pool.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/room/tick_watcher.h"
#include "shared/map/map_definition.h"
#include "shared/state/louse.h"
#include "shared/state/parameters.h"

namespace woodlouse::server {

/// Owned by its room's strand.
class GroundAhead final : public TickWatcher {
 public:
  static constexpr double kAheadSeconds = 2.0;
  static constexpr std::size_t kTurns = 6;  ///< ticks in which all lice are looked at once

  /// Nothing for a map that is in memory as a whole. Begins with the spawn points. `worker` outlives it.
  /// room and map_file name them where the file can't be read any more, which is logged once.
  static std::unique_ptr<GroundAhead> make(std::string room, const map::Map& map, std::string map_file,
                                           boost::asio::thread_pool& worker,
                                           std::shared_ptr<spdlog::logger> log);
  /// Ends the batch at work with the tile it is at.
  ~GroundAhead() override;

  void begin(const match::Match&) override {}
  void rest(const match::Match& game) override;
  void finish(const std::string&, std::function<void()> done) override { done(); }
  void add_figures(RoomFigures& figures) const override;

  /// After a tick.
  void look(std::span<const state::Louse> lice);
  /// Of the map, since it was loaded.
  [[nodiscard]] GroundFigures figures() const;

 private:
  /// Outlives the room where the worker still has a batch.
  struct Shared {
    explicit Shared(terrain::TiledGround the_ground) : ground(std::move(the_ground)) {}
    terrain::TiledGround ground;
    std::atomic<bool> at_work{false};
    std::atomic<bool> stopping{false};
  };

  GroundAhead(std::string room, const terrain::TiledGround& ground, const state::Parameters& physics,
              std::string map_file, boost::asio::thread_pool& worker, std::shared_ptr<spdlog::logger> log);
  void tell_of_failures();
  void add_around(core::Vec2 place, double reach);
  void build();

  std::string room_;
  std::string map_file_;
  boost::asio::thread_pool& worker_;
  std::shared_ptr<spdlog::logger> log_;
  bool told_ = false;  ///< of a file that can't be read
  std::shared_ptr<Shared> shared_;
  const GroundFigures before_;  ///< of games before on the same map
  double push_;                 ///< the largest acceleration that is looked ahead for [m/s^2]
  std::size_t turn_ = 0;
  std::vector<std::size_t> wanted_;  ///< tiles of the next batch
};

}  // namespace woodlouse::server
