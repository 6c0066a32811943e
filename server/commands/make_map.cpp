#include "server/commands/make_map.h"

#include <cmath>
#include <fstream>
#include <memory>
#include <ostream>
#include <system_error>
#include <utility>

#include "server/commands/map_crop.h"
#include "server/commands/map_layout.h"
#include "server/commands/map_summary.h"
#include "shared/core/printable.h"
#include "shared/json/object_text.h"
#include "shared/map/canonical_map.h"
#include "shared/map/grid_folder_file.h"
#include "shared/map/map_file.h"
#include "shared/map/map_text.h"
#include "shared/map/spawns.h"

namespace woodlouse::server {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return file.parent_path().empty() ? fs::path(".") : file.parent_path();
}

/// The whole file as the ground of a map that has nothing else.
core::Expected<std::shared_ptr<const map::Map>> whole_of(const MakeMapRequest& request,
                                                         const std::string& name) {
  std::string text;
  json::ObjectText map(text);
  map.text("name", name);
  map.object("terrain", [&](json::ObjectText& terrain) {
    terrain.text("file", request.file.filename().string()).number("scale", request.scale);
  });
  map.end();
  const map::DiskFolder folder(folder_of(request.file));
  return map::parse_map(text, request.file.string(), &folder);
}

/// Deep inside voids of a big map, whose tiles are filled each by itself: no cliff to the level of the sea.
double mean_height(const terrain::HeightGrid& overview) {
  double sum = 0.0;
  for (const double z : overview.heights) sum += z;
  return std::round(sum / static_cast<double>(overview.heights.size()));
}

/// The part that was asked for as a map that has nothing else.
core::Expected<std::shared_ptr<const map::Map>> part_of(const MakeMapRequest& request,
                                                        const std::string& name) {
  auto part = cropped_ground(request.file, request.crop, request.scale);
  if (!part) return tl::unexpected(part.error());
  map::MapDefinition definition;
  definition.name = name;
  definition.ground_note = std::move(part->note);
  definition.spawns = map::default_spawns(part->grid.domain());
  definition.terrain = std::move(part->grid);
  auto made = map::parse_map(map::canonical_text(definition), request.file.string(), nullptr);
  if (!made) return tl::unexpected(made.error());
  auto map = std::make_shared<map::Map>(**made);
  map->definition.ground_note = std::move(definition.ground_note);
  return map;
}

core::Expected<map::MapDefinition> definition_of(const MakeMapRequest& request, const std::string& name,
                                                 const fs::path& target, std::string& note) {
  const auto ground = request.crop.empty() ? whole_of(request, name) : part_of(request, name);
  if (!ground) return tl::unexpected(ground.error());
  const terrain::Terrain& terrain = *(*ground)->terrain;
  map::MapDefinition definition = (*ground)->definition;
  note = definition.ground_note;
  if (auto* tiled = std::get_if<map::TiledTerrain>(&definition.terrain)) {
    std::error_code error;
    if (!fs::equivalent(folder_of(request.file), folder_of(target), error)) {
      return core::fail(target.string(), "lies in another folder than " + request.file.filename().string(),
                        "a map of more than 4000000 knots names its file: write it beside, or --crop");
    }
    tiled->fill_level = mean_height(tiled->overview);
  }
  definition.physics.thrust_max = thrust_for(terrain, definition.physics);
  definition.spawns = spawns_for(terrain);
  if (request.modes) definition.modes = modes_for(terrain);
  return definition;
}

core::Expected<void> write_new(const fs::path& target, const std::string& text) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(target, error))) {
    return core::fail(target.string(), "is there already", "name another with --out, or remove it");
  }
  std::ofstream file(target, std::ios::binary);
  const bool is_mine = file.is_open();
  file << text << '\n';
  if (file.flush()) return {};
  file.close();
  if (is_mine) fs::remove(target, error);
  return core::fail(target.string(), "can't be written", "check the folder and the space on its disk");
}

/// A map that stands in its file.
struct MadeMap {
  fs::path file;
  std::shared_ptr<const map::Map> map;
};

core::Expected<MadeMap> make(const MakeMapRequest& request, std::string& note) {
  const std::string name = request.name.empty() ? request.file.stem().string() : request.name;
  const fs::path target =
      request.out.value_or(folder_of(request.file) / (request.file.stem().string() + ".json"));
  const auto definition = definition_of(request, name, target, note);
  if (!definition) return tl::unexpected(definition.error());
  const std::string text = map::canonical_text(*definition);
  // Read as a server will, before a file stands that none would take.
  const map::DiskFolder folder(folder_of(target));
  auto map = map::parse_map(text, target.string(), &folder);
  if (!map) return tl::unexpected(map.error());
  if (auto written = write_new(target, text); !written) return tl::unexpected(written.error());
  return MadeMap{target, std::move(*map)};
}

}  // namespace

int make_map_command(const MakeMapRequest& request, std::ostream& out) {
  std::string note;
  const auto made = make(request, note);
  if (!made) {
    out << made.error().text() << '\n';
    return 1;
  }
  const map::Map& map = *made->map;
  const std::string name = core::printable(made->file.string());
  if (!note.empty()) out << core::printable(request.file.string()) << ": " << note << '\n';
  for (const std::string& line : summary_of(map)) out << name << ": " << line << '\n';
  if (map.definition.modes.forage && !map.definition.modes.race)
    out << name << ": no race: it wants a map 20 m across or more (--scale)\n";
  out << name << ": thrust " << map.definition.physics.thrust_max << " m/s^2, "
      << map.definition.spawns.size() << " spawns; play it:  woodlouse-server --map " << name
      << " --bots 8\n";
  return 0;
}

}  // namespace woodlouse::server
