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

std::optional<TerrainDefinition> read_whole(const terrain::HeightSource& heights, double fill_level,
                                            const std::string& source, json::Problems& problems) {
  auto grid = read_all_heights(heights, fill_level, source);
  if (grid) return std::move(*grid);
  problems.add(grid.error());
  return std::nullopt;
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

bool is_float_grid(std::string_view path) {
  constexpr std::string_view kEnd = ".flt";
  if (path.size() <= kEnd.size() || path[path.size() - kEnd.size() - 1] == '/') return false;
  const std::string_view end = path.substr(path.size() - kEnd.size());
  return std::equal(end.begin(), end.end(), kEnd.begin(), [](char ours, char theirs) {
    return (ours >= 'A' && ours <= 'Z' ? static_cast<char>(ours - 'A' + 'a') : ours) == theirs;
  });
}

std::optional<TerrainDefinition> read_float_grid(const json::Value& value, const GridFolder& folder,
                                                 const std::string& path, json::Problems& problems) {
  const json::Fields fields(value, {"file", "scale", "fill_level", "storage", "fingerprint"}, problems);
  TiledTerrain terrain;
  terrain.scale = fields.number_or("scale", kGridScale, 1.0);
  terrain.fill_level = fields.number_or("fill_level", kHeight, 0.0);
  const Storage storage = read_storage(fields, problems);
  if (const auto file = fields.find("file")) terrain.file = file->text();
  auto grid = folder.open_heights(path);
  if (!grid) {
    problems.add(grid.error());
    return std::nullopt;
  }
  terrain.heights = std::make_shared<ScaledHeights>(std::move(*grid), terrain.scale, kHeight.max);
  const terrain::GridFrame frame = terrain.heights->frame();
  if (!check_frame(value, frame, problems)) return std::nullopt;
  auto surveyed = survey(fields, terrain, path, problems);
  if (!surveyed) return std::nullopt;
  const bool is_small = frame.columns * frame.rows <= kMaxKnots;
  if (storage == Storage::kWhole || (storage == Storage::kBySize && is_small)) {
    if (is_small) return read_whole(*terrain.heights, terrain.fill_level, path, problems);
    problems.add(value, core::joined({"more than ", std::to_string(kMaxKnots), " knots can't be read whole"}),
                 "take storage tiles, or leave it out");
    return std::nullopt;
  }
  terrain.fingerprint = surveyed->fingerprint;
  terrain.overview = std::move(surveyed->overview);
  return terrain;
}

}  // namespace woodlouse::map
