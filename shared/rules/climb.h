// What full thrust climbs from rest, and whether a race asks for more: then its track wants a run-up. Pure;
// any thread.
#pragma once

#include "shared/core/vec2.h"
#include "shared/map/map_definition.h"
#include "shared/rules/gate.h"
#include "shared/terrain/surface.h"

namespace woodlouse::rules {

/// The slope that a thrust climbs from rest, friction and all [1]; a large one where it climbs everything.
double climbable_slope(const state::Parameters& physics);

/// The ground at a place, which may be an image outside of the map, or past its edge: there that of the edge.
terrain::SurfaceSample ground_at(const map::Map& map, const Images& images, core::Vec2 place);

/// How far the straight ways from each gate's middle to the next one's, and from the last to the first, climb
/// more than full thrust does from rest, all together [m]. REQUIRES a map with a race.
double length_of_run_ups(const map::Map& map);

}  // namespace woodlouse::rules
