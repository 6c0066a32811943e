// Where lice start: in a map file, in the canonical map, and on a map that does not say.
#pragma once

#include <vector>

#include "shared/core/vec2.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/json/object_text.h"
#include "shared/map/modes.h"
#include "shared/state/louse.h"
#include "shared/terrain/surface.h"

namespace woodlouse::map {

/// A list of 1 to 1024 spawn points within the domain.
std::vector<SpawnPoint> read_spawns(const json::Value& value, const terrain::Rectangle& domain,
                                    json::Problems& problems);
/// As the member `spawns`.
void add_spawns(json::ObjectText& text, const std::vector<SpawnPoint>& spawns);

/// Where lice start on a map that does not say: eight points on a ring around the middle, looking inwards.
std::vector<SpawnPoint> default_spawns(const terrain::Rectangle& domain);

/// Who begins there.
state::Louse louse_at(const SpawnPoint& spawn, state::LouseId id);

/// The unit vector at `degrees` counter-clockwise from +x; the same bits everywhere, exact at multiples
/// of 90.
core::Vec2 heading_from_degrees(double degrees);

}  // namespace woodlouse::map
