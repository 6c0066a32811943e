#include "shared/map/map_world.h"

#include <cassert>

#include "shared/physics/ground_steps.h"

namespace woodlouse::map {

state::Parameters physics_of(const MapDefinition& map, state::Mode mode) {
  assert(map.modes.has(mode));
  state::Parameters physics = map.physics;
  if (mode == state::Mode::kHill && map.modes.hill->falls) physics.edges = state::Edges::kOpen;
  return physics;
}

physics::World make_world(const Map& map, double step, state::Mode mode) {
  assert(map.detail == Detail::kExact);
  const state::Parameters parameters = physics_of(map.definition, mode);
  if (!map.make_steps) return physics::World(map.terrain, parameters, step);
  const terrain::Rectangle walls = map.terrain->domain();
  return physics::World(map.terrain, parameters, step, walls, map.make_steps({parameters, walls, step}));
}

}  // namespace woodlouse::map
