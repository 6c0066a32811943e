#include "server/watchers/ground_ahead.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <cmath>
#include <utility>
#include <variant>

#include "server/logging/events.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {

std::unique_ptr<GroundAhead> GroundAhead::make(std::string room, const map::Map& map, std::string map_file,
                                               boost::asio::thread_pool& worker,
                                               std::shared_ptr<spdlog::logger> log) {
  const auto* ground = std::get_if<terrain::TiledGround>(&map.terrain->surface());
  if (ground == nullptr) return nullptr;
  std::unique_ptr<GroundAhead> ahead(new GroundAhead(std::move(room), *ground, map.definition.physics,
                                                     std::move(map_file), worker, std::move(log)));
  for (const map::SpawnPoint& spawn : map.definition.spawns) ahead->add_around(spawn.position, 0.0);
  ahead->build();
  return ahead;
}

GroundAhead::GroundAhead(std::string room, const terrain::TiledGround& ground,
                         const state::Parameters& physics, std::string map_file,
                         boost::asio::thread_pool& worker, std::shared_ptr<spdlog::logger> log)
    : room_(std::move(room)),
      map_file_(std::move(map_file)),
      worker_(worker),
      log_(std::move(log)),
      shared_(std::make_shared<Shared>(ground)),
      before_(figures()),
      push_(physics.thrust_max + physics.gravity) {}

void GroundAhead::rest(const match::Match& game) {
  look(game.world().lice());
  if (!told_ && game.tick() % game.settings().tick_hz == 0) tell_of_failures();  // once a second
}

void GroundAhead::tell_of_failures() {
  const std::uint64_t failures = figures().read_failures;
  if (failures == 0) return;
  told_ = true;
  log_event(
      *log_, LogEvent::kMapUnreadable,
      fmt::format(
          "room {}: the map's file can't be read any more ({} reads failed; {}). Where it could not, ground "
          "without data "
          "stands in: the game goes on, its recording may not verify. Check the disk, and that nobody "
          "changed "
          "the file",
          room_, failures, map_file_));
}

GroundAhead::~GroundAhead() { shared_->stopping = true; }

void GroundAhead::look(std::span<const state::Louse> lice) {
  turn_ = (turn_ + 1) % kTurns;
  if (shared_->at_work) return;
  const double farthest = static_cast<double>(terrain::BSplineTile::kCells) * shared_->ground.cell();
  for (std::size_t i = turn_; i < lice.size(); i += kTurns) {
    const state::Louse& louse = lice[i];
    if (louse.phase == state::Phase::kResting) continue;
    const double reach =
        kAheadSeconds * (std::sqrt(dot(louse.velocity, louse.velocity)) + 0.5 * kAheadSeconds * push_);
    add_around(louse.position, std::min(reach, farthest));
  }
  build();
}

void GroundAhead::add_around(core::Vec2 place, double reach) {
  const terrain::BSplineLayout& layout = shared_->ground.layout();
  // At most a tile away: the corners, the sides' middles and the place itself meet every tile of the square.
  for (const double x : {place.x - reach, place.x, place.x + reach}) {
    for (const double y : {place.y - reach, place.y, place.y + reach}) {
      wanted_.push_back(layout.tile_of(layout.cell_at(x, y)));
    }
  }
}

void GroundAhead::build() {
  std::sort(wanted_.begin(), wanted_.end());
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
  wanted_.resize(std::min(wanted_.size(), std::max<std::size_t>(1, shared_->ground.tiles().max_tiles() / 2)));
  if (wanted_.empty()) return;
  shared_->at_work = true;
  boost::asio::post(worker_, [shared = shared_, tiles = std::exchange(wanted_, {})] {
    for (const std::size_t tile : tiles) {
      if (shared->stopping) break;
      shared->ground.tiles().prepare(tile);
    }
    shared->at_work = false;
  });
}

GroundFigures GroundAhead::figures() const {
  const terrain::TileStore& tiles = shared_->ground.tiles();
  const terrain::TileStore::Counters counters = tiles.counters();
  return {counters.live, counters.built, counters.prepared, counters.thrown_out,
          tiles.source().read_failures()};
}

void GroundAhead::add_figures(RoomFigures& figures) const {
  GroundFigures& all = figures.ground ? *figures.ground : figures.ground.emplace();
  const GroundFigures now = this->figures();
  all.live = now.live;
  all.built += now.built - before_.built;
  all.ahead += now.ahead - before_.ahead;
  all.thrown_out += now.thrown_out - before_.thrown_out;
  all.read_failures += now.read_failures - before_.read_failures;
}

}  // namespace woodlouse::server
