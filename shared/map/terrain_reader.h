// The `terrain` object of a map file: a named function, a grid file, or heights in place.
#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "shared/json/document.h"
#include "shared/map/checked_fields.h"
#include "shared/map/map_definition.h"

namespace woodlouse::map {

using TerrainDefinition = std::variant<FunctionTerrain, terrain::HeightGrid>;

/// Nothing, and at least one problem, when something is wrong.
std::optional<TerrainDefinition> read_terrain(const json::Value& value, const std::filesystem::path& folder,
                                              Problems& problems);

}  // namespace woodlouse::map
