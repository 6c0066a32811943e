// From the JSON of a map file to its definition: every key, type and range, all problems told.
#pragma once

#include <optional>

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/map/map_definition.h"
#include "shared/map/terrain_reader.h"

namespace woodlouse::map {

/// Nothing, and at least one problem, when something is wrong.
std::optional<MapDefinition> read_definition(const json::Value& root, const GridPlace& place,
                                             json::Problems& problems);

}  // namespace woodlouse::map
