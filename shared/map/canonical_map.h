// A map as one line of JSON: what is hashed, sent to clients and put into recordings.
#pragma once

#include <string>

#include "shared/map/map_definition.h"
#include "shared/terrain/height_grid.h"

namespace woodlouse::map {

/// The heights a spline is laid through. REQUIRES that they are in memory: no TiledTerrain.
terrain::HeightGrid knots_of(const MapDefinition& definition);

/// The definition as the loader reads it back, bit for bit: every field in place, defaults included, doubles
/// in their shortest form. Heights stand in place, but for SurfaceKind::kFunction, which keeps its function,
/// and a TiledTerrain, which keeps its file and names its fingerprint.
std::string canonical_text(const MapDefinition& definition);

}  // namespace woodlouse::map
