// Which games the command line asks for: each map's modes, a room each, or in turns in one room.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "server/config.h"
#include "server/room/start.h"
#include "server/stream/map_shelf.h"
#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/match/match.h"
#include "shared/state/mode.h"

namespace woodlouse::server {

struct ChosenGame {
  std::string room;  ///< what its own room is called: `volcano`, `volcano/race`; no two are the same
  std::shared_ptr<const map::Map> map;
  std::filesystem::path map_file;
  state::Mode mode = state::Mode::kRoam;
};

/// Of the room of a map's mode: roam, which every map has, goes by the map's name alone.
std::string room_name(const std::string& map, state::Mode mode);

/// In the order of --map, and of each its modes. Games of one file share its map, which stays in the caches;
/// of a big one's tiles each has its own. Errors: where = the map's file, or the option.
core::Expected<std::vector<ChosenGame>> choose_games(const ServeConfig& config);

/// Each has the map that is on the shelf where it is the same, down to what is no part of its hash; of a big
/// one's tiles each has its own.
void share_maps(std::vector<ChosenGame>& games, MapShelf& shelf);

/// With the house's bots, where they play by rules: of a long course that takes seconds.
Start start_of(const ChosenGame& game, const ServeConfig& config, std::uint64_t seed);

}  // namespace woodlouse::server
