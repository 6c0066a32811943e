// A `terrain` object that names an ESRI float grid (flt_grid.h): read whole while it is small, else from its
// file, tile by tile, where lice are.
#pragma once

#include <filesystem>
#include <optional>

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/map/terrain_reader.h"

namespace woodlouse::map {

/// Whether the name ends in .flt, in any case.
bool is_float_grid(const std::filesystem::path& file);

/// A HeightGrid, not yet checked, or a TiledTerrain; nothing, and at least one problem, when something is
/// wrong. Knots without data are filled (terrain/fill_missing.h). `path`: the .flt.
std::optional<TerrainDefinition> read_float_grid(const json::Value& value, const std::filesystem::path& path,
                                                 json::Problems& problems);

}  // namespace woodlouse::map
