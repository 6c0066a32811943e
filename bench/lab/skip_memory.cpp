#include "bench/lab/skip_memory.h"

#include <malloc.h>
#include <boost/asio/io_context.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bench/lab/problems/motion.h"
#include "server/room/room.h"
#include "server/timing/steady_timekeeper.h"
#include "shared/core/random.h"
#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"
#include "shared/map/map_world.h"
#include "shared/state/state_hash.h"

namespace woodlouse::lab {
namespace {

/// What is allocated now [bytes].
double allocated() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// Bytes a louse of a world, its lists and its blocks' hashes, once it has stepped.
double bytes_of_louse(const map::Map& map, std::uint32_t count, bool moves) {
  std::vector<state::Louse> lice;
  core::Random random(5);
  const auto symmetric = [&](double size) { return size * (2.0 * random.uniform() - 1.0); };
  for (state::LouseId id = 1; id <= count; ++id) {
    lice.push_back(louse_at({symmetric(15.0), symmetric(15.0)}, {}));
    lice.back().id = id;
    if (moves) lice.back().velocity = {symmetric(5.0), symmetric(5.0)};
    if (!moves) lice.back().phase = state::Phase::kResting;
  }
  const double before = allocated();
  physics::World world = map::make_world(map, 1.0 / 60.0);
  world.restore(lice);
  state::BlockHashes hashes;
  for (int tick = 0; tick < 10; ++tick) {
    world.step();
    hashes.update(world.lice(), world.changed_blocks());
    world.forget_changes();
  }
  return (allocated() - before) / count;
}

/// Bytes a room of that map in which nobody is, which many share.
double bytes_of_empty_room(const std::shared_ptr<const map::Map>& map, int count) {
  boost::asio::io_context io, ticks;
  const server::Lanes lanes(io, 1);
  server::SteadyTimekeeper timekeeper;
  const auto log = std::make_shared<spdlog::logger>("lab");
  std::vector<std::shared_ptr<server::Room>> rooms;
  rooms.reserve(static_cast<std::size_t>(count));
  const double before = allocated();
  for (int i = 0; i < count; ++i) {
    server::RoomSettings settings;
    settings.name = "room " + std::to_string(i);
    auto match = std::make_unique<match::Match>(map, match::MatchSettings{60, 1});
    rooms.push_back(server::Room::make(ticks, lanes, settings,
                                       {map, std::move(match), "volcano.json", {}, {}}, {}, timekeeper, log));
  }
  return (allocated() - before) / count;
}

}  // namespace

core::Expected<void> measure_memory(Table& table, Effort effort) {
  const auto file = map::find_map("volcano");
  if (!file) return tl::unexpected(file.error());
  const auto map = map::load_map(*file);
  if (!map) return tl::unexpected(map.error());
  const std::uint32_t lice = effort == Effort::kQuick ? 1000 : 100000;
  const std::string of = ", of " + std::to_string(lice);
  table.add({"a louse's memory, moving; at rest" + of, "bytes", bytes_of_louse(**map, lice, true),
             bytes_of_louse(**map, lice, false)});
  table.add({"an empty room's memory, beside its map", "bytes", std::string("-"),
             bytes_of_empty_room(*map, effort == Effort::kQuick ? 10 : 1000)});
  return {};
}

}  // namespace woodlouse::lab
