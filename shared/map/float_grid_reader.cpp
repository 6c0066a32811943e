#include "shared/map/float_grid_reader.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/map/height_survey.h"
#include "shared/map/map_text.h"
#include "shared/map/scaled_heights.h"
#include "shared/map/terrain_ranges.h"

namespace woodlouse::map {
namespace {

enum class Storage { kBySize, kWhole, kTiles };

Storage read_storage(const json::Fields& fields, json::Problems& problems) {
  const auto value = fields.find("storage");
  if (!value) return Storage::kBySize;
  if (value->is(json::Kind::kString)) {
    if (value->text() == "whole") return Storage::kWhole;
    if (value->text() == "tiles") return Storage::kTiles;
  }
  problems.add(*value, "is none of its choices", "whole or tiles; left out, the size decides");
  return Storage::kBySize;
}

/// Whether the file's frame is one that a map may have.
bool check_frame(const json::Value& value, const terrain::GridFrame& frame, json::Problems& problems) {
  if (!within(frame.dx, kSpacing) || !within(frame.dy, kSpacing)) {
    problems.add(value, "knots less than 1 mm or more than 1000 km apart", "choose another scale");
  } else if (!within(frame.x_origin, kOrigin) || !within(frame.y_origin, kOrigin)) {
    problems.add(value, "the origin is more than 10000 km off", "choose another scale");
  } else {
    return true;
  }
  return false;
}

/// All heights as ground: holes are filled at once.
std::optional<TerrainDefinition> read_whole(const TiledTerrain& terrain, elevation::GroundOptions options,
                                            const std::string& source, std::string& note,
                                            json::Problems& problems) {
  auto file = read_all_heights(*terrain.heights, source);
  if (!file) {
    problems.add(file.error());
    return std::nullopt;
  }
  options.scale = 1.0;  // both are in these heights
  options.unit = elevation::LengthUnit::kMetres;
  auto ground = elevation::make_ground(std::move(*file), options, source);
  if (!ground) {
    problems.add(ground.error());
    return std::nullopt;
  }
  if (!ground->note.empty()) note += (note.empty() ? "" : ", ") + ground->note;
  return std::move(ground->grid);
}

/// The steepest step eastwards in up to 64 rows at equal distances, as if the frame were in metres: enough to
/// tell degrees.
double steepest_of_some_rows(const terrain::HeightSource& heights) {
  constexpr std::size_t kRows = 64;
  const terrain::GridFrame frame = heights.frame();
  terrain::HeightGrid row{frame.columns, 1, 0.0, 0.0, frame.dx, frame.dy, {}};
  row.heights.resize(frame.columns);
  double steepest = 0.0;
  for (std::size_t j = 0; j < std::min(kRows, frame.rows); ++j) {
    heights.read(0, j * (frame.rows - 1) / (std::min(kRows, frame.rows) - 1), row.heights);
    steepest = std::max(steepest, elevation::steepest_step(row));
  }
  return steepest;
}

bool is_in_degrees(const terrain::HeightSource& heights, elevation::LengthUnit unit, bool is_srtm) {
  if (unit != elevation::LengthUnit::kByLooks) return unit == elevation::LengthUnit::kDegrees;
  return is_srtm || is_in_degrees_by_looks(heights);
}

std::optional<elevation::LengthUnit> unit_from_text(std::string_view text) {
  if (text == "metres") return elevation::LengthUnit::kMetres;
  if (text == "degrees") return elevation::LengthUnit::kDegrees;
  return std::nullopt;
}

std::optional<elevation::Rim> rim_from_text(std::string_view text) {
  if (text == "cut") return elevation::Rim::kCut;
  if (text == "fill") return elevation::Rim::kFill;
  return std::nullopt;
}

bool ends_in(std::string_view path, std::string_view ending) {
  if (path.size() <= ending.size() || path[path.size() - ending.size() - 1] == '/') return false;
  const std::string_view end = path.substr(path.size() - ending.size());
  return std::equal(end.begin(), end.end(), ending.begin(), [](char ours, char theirs) {
    return (ours >= 'A' && ours <= 'Z' ? static_cast<char>(ours - 'A' + 'a') : ours) == theirs;
  });
}

/// The survey, if the file is the one that the map names the fingerprint of.
std::optional<HeightSurvey> survey(const json::Fields& fields, const TiledTerrain& terrain,
                                   const std::string& source, json::Problems& problems) {
  auto result = survey_heights(*terrain.heights, terrain.fill_level, source);
  if (!result) {
    problems.add(result.error());
    return std::nullopt;
  }
  const auto wanted = fields.find("fingerprint");
  const std::string found = core::to_hex(result->fingerprint);
  if (wanted && !(wanted->is(json::Kind::kString) && wanted->text() == found)) {
    problems.add(*wanted, core::joined({"is not the fingerprint of ", source, ", which is \"", found, "\""}),
                 "take the file the map was made with, or leave fingerprint out");
    return std::nullopt;
  }
  return std::move(*result);
}

}  // namespace

bool is_float_grid(std::string_view path) { return ends_in(path, ".flt"); }

bool is_srtm_tile(std::string_view path) { return ends_in(path, ".hgt"); }

bool is_in_degrees_by_looks(const terrain::HeightSource& heights) {
  return elevation::looks_like_degrees(heights.frame(), steepest_of_some_rows(heights));
}

elevation::GroundOptions read_ground_options(const json::Fields& fields, json::Problems& problems) {
  elevation::GroundOptions options;
  options.scale = fields.number_or("scale", kGridScale, 1.0);
  if (fields.find("fill_level")) options.fill_level = fields.number_or("fill_level", kHeight, 0.0);
  if (const auto unit = fields.find("unit")) {
    const auto found = json::choice_of(*unit, unit_from_text);
    if (!found)
      problems.add(*unit, "is none of its choices", "metres or degrees; left out, the file's looks decide");
    options.unit = found.value_or(options.unit);
  }
  if (const auto rim = fields.find("rim")) {
    const auto found = json::choice_of(*rim, rim_from_text);
    if (!found) problems.add(*rim, "is none of its choices", "cut (the default) or fill");
    options.rim = found.value_or(options.rim);
  }
  return options;
}

std::optional<TerrainDefinition> read_float_grid(const json::Value& value, const GridFolder& folder,
                                                 const std::string& path, std::string& note,
                                                 json::Problems& problems) {
  const json::Fields fields(
      value, {"file", "scale", "fill_level", "storage", "fingerprint", "unit", "rim", "corner"}, problems);
  const elevation::GroundOptions options = read_ground_options(fields, problems);
  TiledTerrain terrain;
  terrain.scale = options.scale;
  terrain.fill_level = options.fill_level.value_or(0.0);
  const Storage storage = read_storage(fields, problems);
  if (const auto file = fields.find("file")) terrain.file = file->text();
  if (const auto corner = fields.find("corner")) {
    constexpr json::Range kDegrees{-180.0, 180.0, "degrees"};
    terrain.corner = json::pair_in(*corner, kDegrees, problems);
    if (!is_srtm_tile(path)) problems.add(*corner, "only an SRTM tile (.hgt) has one", "leave it out");
  }
  if (problems.count() != 0) return std::nullopt;
  auto grid = folder.open_heights(path, terrain.corner);
  if (!grid) {
    problems.add(grid.error());
    return std::nullopt;
  }
  terrain::GridFrame metres = (*grid)->frame();
  terrain.is_in_degrees = is_in_degrees(**grid, options.unit, is_srtm_tile(path));
  if (terrain.is_in_degrees) {
    note = elevation::degrees_note(metres);
    metres = elevation::in_metres(metres);
  }
  terrain.heights = std::make_shared<ScaledHeights>(std::move(*grid), metres, terrain.scale, kHeight.max);
  const terrain::GridFrame frame = terrain.heights->frame();
  if (!check_frame(value, frame, problems)) return std::nullopt;
  auto surveyed = survey(fields, terrain, path, problems);
  if (!surveyed) return std::nullopt;
  const bool is_small = frame.columns * frame.rows <= kMaxKnots;
  if (storage == Storage::kWhole || (storage == Storage::kBySize && is_small)) {
    if (is_small) return read_whole(terrain, options, path, note, problems);
    problems.add(value, core::joined({"more than ", std::to_string(kMaxKnots), " knots can't be read whole"}),
                 "take storage tiles, or leave it out");
    return std::nullopt;
  }
  // Not all of it has been read: a mark that no surveyed row has counts as no data too, but is not told of.
  if (const auto mark = terrain.heights->undeclared_mark())
    note += (note.empty() ? "" : ", ") + elevation::mark_note(*mark);
  terrain.fingerprint = surveyed->fingerprint;
  terrain.overview = std::move(surveyed->overview);
  return terrain;
}

}  // namespace woodlouse::map
