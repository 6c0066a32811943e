#include "server/commands/make_map.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <ostream>
#include <span>
#include <system_error>
#include <utility>

#include "server/commands/map_layout.h"
#include "server/commands/map_summary.h"
#include "shared/core/printable.h"
#include "shared/elevation/degrees.h"
#include "shared/elevation/hgt_grid_file.h"
#include "shared/json/object_text.h"
#include "shared/map/canonical_map.h"
#include "shared/map/float_grid_reader.h"
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

/// The part asked for in metres of the map [scale applied], x_min > x_max where it is none.
terrain::Rectangle crop_in_metres(const MakeMapRequest& request) {
  core::Vec2 metres{request.scale, request.scale};
  core::Vec2 middle;
  if (const auto corner = elevation::corner_of_name(request.file.filename().string());
      corner && map::is_srtm_tile(request.file.string())) {
    middle = *corner + core::Vec2{0.5, 0.5};
    const core::Vec2 degree = elevation::metres_a_degree(std::clamp(middle.y, -89.0, 89.0));
    metres = {request.scale * degree.x, request.scale * degree.y};
  }
  const auto& c = request.crop;
  return {(c[0] - middle.x) * metres.x, (c[1] - middle.y) * metres.y, (c[2] - middle.x) * metres.x,
          (c[3] - middle.y) * metres.y};
}

/// Knots first .. last of `count` from `origin` on that lie within low .. high.
struct Knots {
  std::size_t first = 0;
  std::size_t count = 0;
};

Knots knots_within(double low, double high, double origin, double step, std::size_t count) {
  const double last = static_cast<double>(count - 1);
  const double begin = std::clamp(std::ceil((low - origin) / step - 1e-6), 0.0, last);
  const double end = std::clamp(std::floor((high - origin) / step + 1e-6), 0.0, last);
  if (!(begin <= end)) return {};
  return {static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin) + 1};
}

core::Expected<elevation::Ground> cropped(const map::MapDefinition& map, const terrain::Rectangle& part,
                                          const std::string& source) {
  const auto* whole = std::get_if<terrain::HeightGrid>(&map.terrain);
  const auto* tiled = std::get_if<map::TiledTerrain>(&map.terrain);
  const terrain::GridFrame frame = tiled != nullptr
                                       ? tiled->heights->frame()
                                       : terrain::GridFrame{whole->columns,  whole->rows, whole->x_origin,
                                                            whole->y_origin, whole->dx,   whole->dy};
  const Knots columns = knots_within(part.x_min, part.x_max, frame.x_origin, frame.dx, frame.columns);
  const Knots rows = knots_within(part.y_min, part.y_max, frame.y_origin, frame.dy, frame.rows);
  if (columns.count < 4 || rows.count < 4) {
    return core::fail("--crop", "leaves less than 4 knots each way",
                      "west,south,east,north: of an .hgt in degrees, else in metres from the grid's middle");
  }
  if (columns.count > map::kMaxKnots / rows.count)
    return core::fail("--crop", "leaves more than " + std::to_string(map::kMaxKnots) + " knots", "crop more");
  elevation::FileGrid grid;
  grid.columns = columns.count;
  grid.rows = rows.count;
  grid.dx = frame.dx;
  grid.dy = frame.dy;
  grid.heights.resize(columns.count * rows.count);
  for (std::size_t j = 0; j < rows.count; ++j) {
    const auto row = std::span(grid.heights).subspan(j * columns.count, columns.count);
    if (tiled != nullptr) {
      tiled->heights->read(columns.first, rows.first + j, row);
    } else {
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = whole->at(columns.first + i, rows.first + j);
    }
  }
  elevation::GroundOptions options;
  options.unit = elevation::LengthUnit::kMetres;
  return elevation::make_ground(std::move(grid), options, source);
}

/// Deep inside voids of a big map, whose tiles are filled each by itself: no cliff to the level of the sea.
double mean_height(const terrain::HeightGrid& overview) {
  double sum = 0.0;
  for (const double z : overview.heights) sum += z;
  return std::round(sum / static_cast<double>(overview.heights.size()));
}

core::Expected<map::MapDefinition> definition_of(const MakeMapRequest& request, const std::string& name,
                                                 const fs::path& target, std::string& note) {
  auto whole = whole_of(request, name);
  if (!whole) return tl::unexpected(whole.error());
  map::MapDefinition definition = (*whole)->definition;
  note = definition.ground_note;
  std::shared_ptr<const map::Map> ground = *whole;
  if (!request.crop.empty()) {
    auto part = cropped(definition, crop_in_metres(request), request.file.string());
    if (!part) return tl::unexpected(part.error());
    if (!part->note.empty()) note += (note.empty() ? "" : ", ") + part->note;
    definition.terrain = std::move(part->grid);
    definition.spawns = map::default_spawns(std::get<terrain::HeightGrid>(definition.terrain).domain());
    auto made = map::parse_map(map::canonical_text(definition), request.file.string(), nullptr);
    if (!made) return tl::unexpected(made.error());
    ground = std::move(*made);
  }
  if (auto* tiled = std::get_if<map::TiledTerrain>(&definition.terrain)) {
    std::error_code error;
    if (!fs::equivalent(folder_of(request.file), folder_of(target), error)) {
      return core::fail(target.string(), "lies in another folder than " + request.file.filename().string(),
                        "a map of more than 4000000 knots names its file: write it beside, or --crop");
    }
    tiled->fill_level = mean_height(tiled->overview);
  }
  definition.physics.thrust_max = thrust_for(*ground->terrain, definition.physics);
  definition.spawns = spawns_for(*ground->terrain);
  if (request.modes) definition.modes = modes_for(*ground->terrain);
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
