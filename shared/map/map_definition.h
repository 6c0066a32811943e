// What a map file says: the terrain, its physics and where lice start. Field by field in maps/README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/map/modes.h"
#include "shared/physics/ground_steps.h"
#include "shared/state/parameters.h"
#include "shared/terrain/function_surface.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/height_source.h"
#include "shared/terrain/spline_1d.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::map {

/// Which surface is laid through the terrain's heights.
enum class SurfaceKind {
  kSpline,         ///< "spline": bicubic, not-a-knot ends (default)
  kNaturalSpline,  ///< "natural_spline": bicubic, the document's natural ends
  kFunction,       ///< "function": the named function itself; only with a function terrain
  // The paper's, for its equations alone (document/surface_catalogue.h):
  kBiquadratic,      ///< "biquadratic"
  kBlended,          ///< "blended"
  kBlendedDocument,  ///< "blended_document": as its source code has it
  kGauss,            ///< "gauss": the gradient by least squares
  kDocumentSpline,   ///< "document_spline": the global spline, evaluated as its source code does
};

/// By name, "spline" and so on.
std::string_view to_text(SurfaceKind kind);
std::optional<SurfaceKind> surface_from_text(std::string_view text);
/// Of the paper: no curvature for the exact equations.
constexpr bool is_of_document(SurfaceKind kind) { return kind >= SurfaceKind::kBiquadratic; }

/// A named function, sampled at (2 grid + 1)^2 knots (for SurfaceKind::kFunction only drawn from them).
struct FunctionTerrain {
  terrain::FunctionName function = terrain::FunctionName::kVolcano;
  std::size_t grid = 10;
  double scale = 20.0;  ///< half the side of the square [m]; heights are scaled alike
};

/// A grid file that is not read whole: a surface is built where lice are (terrain/tiled_bspline.h).
struct TiledTerrain {
  std::string file;                  ///< as the map names it, in the map's folder
  double scale = 1.0;                ///< on lengths and heights alike; applied in what follows
  bool is_in_degrees = false;        ///< the file's frame; in what follows it is in metres
  std::optional<core::Vec2> corner;  ///< [degrees] south-western, of a tile whose name does not count
  double fill_level = 0.0;           ///< [m] deep inside regions without data
  std::uint64_t fingerprint = 0;     ///< height_survey.h
  std::shared_ptr<const terrain::HeightSource> heights;  ///< any thread may read
  terrain::HeightGrid overview;                          ///< height_survey.h
};

struct MapDefinition {
  std::string name;
  std::variant<FunctionTerrain, terrain::HeightGrid, TiledTerrain>
      terrain;  ///< heights are in metres, scale applied
  SurfaceKind surface = SurfaceKind::kSpline;
  state::Parameters physics;
  std::vector<SpawnPoint> spawns;  ///< at least one
  Modes modes;
  /// What was done to its grid file's heights, in one line; empty: nothing. No part of the map.
  std::string ground_note;
};

/// How far a map's terrain is the one that is played on.
enum class Detail {
  kExact,     ///< bit for bit
  kOverview,  ///< a client's of a big map: for drawing, and nothing may be computed from it
};

/// A map ready to play: immutable, shared between rooms, replays and clients.
struct Map {
  MapDefinition definition;
  Detail detail = Detail::kExact;
  /// The definition as one line of JSON that the loader reads back to the same map; a tiled terrain's beside
  /// its file.
  std::string canonical;
  std::uint64_t hash = 0;  ///< stable_hash(canonical)
  std::shared_ptr<const terrain::Terrain> terrain;
  /// Of a map with the paper's equations; empty: the exact ones (map_world.h). They refer to the map's
  /// surface.
  std::function<std::unique_ptr<const physics::GroundSteps>(const physics::StepRules&)> make_steps;
};

}  // namespace woodlouse::map
