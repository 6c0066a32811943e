#include "server/room_opener.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "server/logging/events.h"
#include "server/version.h"
#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"

namespace woodlouse::server {

core::Expected<std::shared_ptr<Room>> RoomOpener::make(const ServeConfig& config, const std::string& name,
                                                       Start start, Rotation* rotation) {
  assert(!name.empty() && start.match != nullptr);
  RoomSettings settings;
  settings.name = name;
  settings.build = kServerName;
  // A game that goes on from elsewhere has its own ticks, on which frames must fall.
  const std::uint32_t tick_hz = start.match->settings().tick_hz;
  settings.state_hz = std::min(config.state_hz, tick_hz);
  while (tick_hz % settings.state_hz != 0) --settings.state_hz;
  settings.bots = config.bots;
  settings.bots_skill = config.bots_skill;
  settings.bots_alone_play = config.bots_alone_play;
  settings.tick_limit = config.ticks;
  settings.limits = *limits_.now();
  settings.adopts_by_name = config.fork && config.fork->adopts_by_name;
  settings.ends_unclaimed = config.cluster.has_value();
  if (rotation != nullptr) settings.rounds_a_game = *config.rotate;
  std::vector<core::Error> failed;
  Watchers watchers = companions_.make(name, start, failed);
  if (!failed.empty()) return tl::unexpected(failed.front());
  start.match->use(companions_.step_team());
  log_opened(name, settings.state_hz, start);
  return Room::make(ticks_, lanes_, std::move(settings), std::move(start), std::move(watchers), timekeeper_,
                    log_, rotation);
}

void RoomOpener::log_opened(const std::string& room, std::uint32_t state_hz, const Start& start) const {
  const match::Match& match = *start.match;
  const std::string threads =
      match.step_threads() == 1 ? std::string() : fmt::format(", steps by {} threads", match.step_threads());
  if (start.parent)
    log_event(
        *log_, LogEvent::kRoomOpened,
        fmt::format("room {}: goes on from {}, tick {}, hash {}, with {} lice, {} ticks/s, {} frames/s{}{}",
                    room, start.parent->file, match.tick(), core::to_hex(match.hash()),
                    match.world().lice().size(), match.settings().tick_hz, state_hz, threads,
                    start.on_trust.empty() ? "" : core::joined({"; on trust: ", start.on_trust})));
  else {
    const std::string& ground = match.map().definition.ground_note;
    log_event(*log_, LogEvent::kRoomOpened,
              fmt::format("room {}: map {}, {} ticks/s, {} frames/s, seed {}{}{}", room, start.map_file,
                          match.settings().tick_hz, state_hz, match.settings().seed, threads,
                          ground.empty() ? "" : core::joined({"; its ground: ", ground})));
  }
}

}  // namespace woodlouse::server
