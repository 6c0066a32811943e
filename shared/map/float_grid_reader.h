// A `terrain` object that names an ESRI float grid (flt_header.h): read whole while it is small, else from
// its file, tile by tile, where lice are.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/map/terrain_reader.h"

namespace woodlouse::map {

/// Whether the name ends in .flt, in any case.
bool is_float_grid(std::string_view path);

/// A HeightGrid, not yet checked, or a TiledTerrain; nothing, and at least one problem, when something is
/// wrong. Knots without data are filled (terrain/fill_missing.h). `path`: the .flt, as the folder found it.
std::optional<TerrainDefinition> read_float_grid(const json::Value& value, const GridFolder& folder,
                                                 const std::string& path, json::Problems& problems);

}  // namespace woodlouse::map
