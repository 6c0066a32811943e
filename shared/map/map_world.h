// The world a map asks for.
#pragma once

#include "shared/map/map_definition.h"
#include "shared/physics/world.h"

namespace woodlouse::map {

/// By the map's equations, method and surface. step: [s], > 0. REQUIRES a map in full detail.
physics::World make_world(const Map& map, double step);

}  // namespace woodlouse::map
