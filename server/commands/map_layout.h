// Where on a ground one begins and what one drives for, chosen by its slopes.
#pragma once

#include <vector>

#include "shared/map/map_definition.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {

/// A place to be, and how steep it is there.
struct LevelPlace {
  core::Vec2 at;  ///< [m]
  double slope = 0.0;
};

/// Up to `most` places, the flattest first, no two nearer to each other than a sixth of the shorter side, all
/// of them a tenth of it inside the edges. At least one.
std::vector<LevelPlace> level_places(const terrain::Terrain& ground, std::size_t most);

/// A thrust [m/s^2] that climbs four fifths of the ground from rest against friction, so that the rest wants
/// a run-up: 2 to 12, in tenths.
double thrust_for(const terrain::Terrain& ground, const state::Parameters& physics);

/// At rest on level places, looking to the middle.
std::vector<map::SpawnPoint> spawns_for(const terrain::Terrain& ground);

/// Crumbs, hills to hold on level places and, where the ground is 20 m across, a race of six gates on the
/// most level ring that has room.
map::Modes modes_for(const terrain::Terrain& ground);

}  // namespace woodlouse::server
