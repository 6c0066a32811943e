#include "shared/map/map_world.h"

#include <cassert>

#include "shared/physics/ground_steps.h"

namespace woodlouse::map {

physics::World make_world(const Map& map, double step) {
  assert(map.detail == Detail::kExact);
  const state::Parameters& parameters = map.definition.physics;
  if (!map.make_steps) return physics::World(map.terrain, parameters, step);
  const terrain::Rectangle walls = map.terrain->domain();
  return physics::World(map.terrain, parameters, step, walls, map.make_steps({parameters, walls, step}));
}

}  // namespace woodlouse::map
