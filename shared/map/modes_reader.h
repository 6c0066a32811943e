// The modes of play of a map file: `race`, `forage`, `hill`.
#pragma once

#include <string>

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/json/object_text.h"
#include "shared/map/map_definition.h"
#include "shared/map/modes.h"
#include "shared/terrain/surface.h"

namespace woodlouse::map {

/// Those that stand in the map's object. Refused, with file, line and field, beside what is none of its kind
/// or range:
///     race     gates shorter than 1.5 m, nearer than 0.5 m to the map's edge, or that cross; a spawn that
///     moves, or
///              is not 1 to 15 m before the first gate
///     forage   a map without gravity
///     hill     places that are not on the map with all of their radius; edge "fall" where the edges wrap
/// domain: of the terrain; REQUIRES all else of the definition read.
Modes read_modes(const json::Value& root, const MapDefinition& definition, const terrain::Rectangle& domain,
                 json::Problems& problems);

/// As members of the canonical map: without what is no part of its hash.
void add_modes(json::ObjectText& map, const Modes& modes);
/// The mode as an object, whole: as clients are told it. REQUIRES a mode that they have; of roam: {}.
std::string mode_text(const Modes& modes, state::Mode mode);

}  // namespace woodlouse::map
