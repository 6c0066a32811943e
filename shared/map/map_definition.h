// What a map file says: the terrain, its physics and where lice start. Field by field in maps/README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/physics/parameters.h"
#include "shared/terrain/function_surface.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/spline_1d.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::map {

/// Which surface is laid through the terrain's heights.
enum class SurfaceKind {
  kSpline,         ///< "spline": bicubic, not-a-knot ends (default)
  kNaturalSpline,  ///< "natural_spline": bicubic, the document's natural ends
  kFunction,       ///< "function": the named function itself; only with a function terrain
};

/// A named function, sampled at (2 grid + 1)^2 knots (for SurfaceKind::kFunction only drawn from them).
struct FunctionTerrain {
  terrain::FunctionName function = terrain::FunctionName::kVolcano;
  std::size_t grid = 10;
  double scale = 20.0;  ///< half the side of the square [m]; heights are scaled alike
};

struct SpawnPoint {
  core::Vec2 position;           ///< [m], inside the domain
  core::Vec2 heading{1.0, 0.0};  ///< unit vector
  double speed = 0.0;  ///< over the map, along the heading [m/s]
};

struct MapDefinition {
  std::string name;
  std::variant<FunctionTerrain, terrain::HeightGrid> terrain;  ///< heights are in metres, scale applied
  SurfaceKind surface = SurfaceKind::kSpline;
  physics::Parameters physics;
  std::vector<SpawnPoint> spawns;  ///< at least one
};

/// A map ready to play: immutable, shared between rooms, replays and clients.
struct Map {
  MapDefinition definition;
  std::string canonical;   ///< the definition as one line of JSON that the loader reads back to the same map
  std::uint64_t hash = 0;  ///< stable_hash(canonical)
  std::shared_ptr<const terrain::Terrain> terrain;
};

}  // namespace woodlouse::map
