// The `terrain` object of a map file: a named function, a grid file, or heights in place.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/map/grid_folder.h"
#include "shared/map/map_definition.h"

namespace woodlouse::map {

using TerrainDefinition = std::variant<FunctionTerrain, terrain::HeightGrid, TiledTerrain>;

/// Where the heights of a grid file are: in the folder that the file is looked up in (an empty one allows
/// none), or, for a map that came over a wire, in the overview that came with it.
using GridPlace = std::variant<const GridFolder*, terrain::HeightGrid>;

/// Nothing, and at least one problem, when something is wrong. `note`: what was done to a grid file's
/// heights, if anything was (MapDefinition::ground_note).
std::optional<TerrainDefinition> read_terrain(const json::Value& value, const GridPlace& place,
                                              std::string& note, json::Problems& problems);

}  // namespace woodlouse::map
