// A `terrain` object that names an ESRI float grid (flt_header.h): read whole while it is small, else from
// its file, tile by tile, where lice are.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "shared/elevation/ground.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/map/terrain_reader.h"

namespace woodlouse::map {

/// Whether the name ends in .flt, in any case.
bool is_float_grid(std::string_view path);

/// Whether it ends in .hgt, in any case.
bool is_srtm_tile(std::string_view path);

/// Whether a file's frame can only be meant in degrees (elevation::looks_like_degrees), by some of its rows.
bool is_in_degrees_by_looks(const terrain::HeightSource& heights);

/// The members unit, rim, scale and fill_level of a terrain in a file.
elevation::GroundOptions read_ground_options(const json::Fields& fields, json::Problems& problems);

/// A HeightGrid, not yet checked, or a TiledTerrain; nothing, and at least one problem, when something is
/// wrong. Read whole: as elevation/ground.h makes it. In tiles: knots without data are filled where they are
/// needed (terrain/fill_missing.h). `path`: the .flt or .hgt, as the folder found it. `note`: see
/// read_terrain().
std::optional<TerrainDefinition> read_float_grid(const json::Value& value, const GridFolder& folder,
                                                 const std::string& path, std::string& note,
                                                 json::Problems& problems);

}  // namespace woodlouse::map
