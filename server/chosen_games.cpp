#include "server/chosen_games.h"

#include <spdlog/fmt/fmt.h>

#include <cassert>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "shared/map/map_file.h"
#include "shared/map/map_search_file.h"
#include "shared/map/modes_reader.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

std::string unique_name(const std::string& name, std::set<std::string>& taken) {
  std::string result = name;
  for (int number = 2; !taken.insert(result).second; ++number) result = name + '-' + std::to_string(number);
  return result;
}

}  // namespace

std::string room_name(const std::string& map, state::Mode mode) {
  return mode == state::Mode::kRoam ? map : fmt::format("{}/{}", map, state::to_text(mode));
}

core::Expected<std::vector<ChosenGame>> choose_games(const ServeConfig& config) {
  std::set<std::string> names;
  std::vector<ChosenGame> games;
  std::map<fs::path, std::shared_ptr<const map::Map>> shared;
  for (const fs::path& word : config.maps) {
    const auto file = map::find_map(word.string());
    if (!file) return tl::unexpected(file.error());
    std::shared_ptr<const map::Map>& map = shared[*file];
    if (map == nullptr || std::holds_alternative<terrain::TiledGround>(map->terrain->surface())) {
      auto loaded = map::load_map(*file);
      if (!loaded) return tl::unexpected(loaded.error());
      map = std::move(*loaded);
    }
    const std::size_t before = games.size();
    for (const state::Mode mode : state::kModes) {
      if (!map->definition.modes.has(mode) || config.mode.value_or(mode) != mode) continue;
      games.push_back({unique_name(room_name(map->definition.name, mode), names), map, *file, mode});
    }
    if (games.size() == before)
      return core::fail(file->string(), fmt::format("has no {}", state::to_text(*config.mode)),
                        "its modes stand in the map file: maps/README.md");
  }
  if (games.size() > kMaxRooms)
    return core::fail("--map", fmt::format("{} rooms, of all modes together", games.size()),
                      fmt::format("at most {}; --mode takes one of each map", kMaxRooms));
  if (config.rotate && games.size() < 2)
    return core::fail("--rotate", "there is one game alone, and nothing to take turns with",
                      "several maps (--map A --map B), or one of several modes");
  return games;
}

void share_maps(std::vector<ChosenGame>& games, MapShelf& shelf) {
  for (ChosenGame& game : games) {
    if (std::holds_alternative<terrain::TiledGround>(game.map->terrain->surface())) continue;
    std::string text = game.map->canonical;
    for (const state::Mode mode : state::kModes)
      if (game.map->definition.modes.has(mode)) text += map::mode_text(game.map->definition.modes, mode);
    const auto kept = shelf.find_or(text, [&game] { return core::Expected<replay::MapPointer>(game.map); });
    assert(kept && (*kept)->hash == game.map->hash);
    game.map = *kept;
  }
}

Start start_of(const ChosenGame& game, const ServeConfig& config, std::uint64_t seed) {
  const match::MatchSettings settings{config.tick_hz, seed, game.mode};
  Start start{game.map, std::make_unique<match::Match>(game.map, settings), game.map_file.string(), {}, {}};
  if (game.mode != state::Mode::kRoam && config.bots > 0)
    start.team = std::make_unique<bots::Team>(*game.map, settings, config.bots_skill, config.bots);
  return start;
}

}  // namespace woodlouse::server
