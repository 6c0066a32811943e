// The `edges` field of a map file: walls at the rim, open edges, or edges that wrap, and whether the terrain
// can.
#pragma once

#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/map/map_definition.h"

namespace woodlouse::map {

/// What `value` asks for. Wrapping is refused where something would break at the seam:
///     heights       the last column (row) is not the first again within 1e-9 of the heights' range
///     a function    its height, gradient or Hessian differ by more than 1e-9 between opposite rims, at any
///     knot there,
///                   on the unit square
///     natural ends, terrain read tile by tile, central gravity (the pull would jump)
/// REQUIRES all else of the definition read.
state::Edges read_edges(const json::Value& value, const MapDefinition& definition, json::Problems& problems);

}  // namespace woodlouse::map
