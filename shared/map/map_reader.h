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

/// Where lice start on a map that does not say: eight points on a ring around the middle, looking inwards.
std::vector<SpawnPoint> default_spawns(const terrain::Rectangle& domain);

/// The unit vector at `degrees` counter-clockwise from +x; the same bits everywhere, exact at multiples
/// of 90.
core::Vec2 heading_from_degrees(double degrees);

}  // namespace woodlouse::map
