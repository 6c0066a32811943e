// The world a map asks for.
#pragma once

#include "shared/map/map_definition.h"
#include "shared/physics/world.h"
#include "shared/state/mode.h"
#include "shared/state/parameters.h"

namespace woodlouse::map {

/// The map's physics as a mode plays by them: of who falls off the hill, the edges are open. REQUIRES
/// map.definition.modes.has(mode).
state::Parameters physics_of(const MapDefinition& map, state::Mode mode);

/// By the map's equations, method and surface, and the mode's physics. step: [s], > 0. REQUIRES a map in full
/// detail, which has the mode.
physics::World make_world(const Map& map, double step, state::Mode mode = state::Mode::kRoam);

}  // namespace woodlouse::map
