#include "shared/map/map_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/map/canonical_map.h"
#include "shared/map/document_surface.h"
#include "shared/map/edges_reader.h"
#include "shared/map/modes_reader.h"
#include "shared/map/spawns.h"
#include "shared/map/terrain_reader.h"
#include "shared/physics/central_gravity.h"

namespace woodlouse::map {
namespace {

constexpr json::Range kGravity{0.0, 1000.0, "m/s^2"};
constexpr json::Range kDrag{0.0, 100.0, "1/s"};
constexpr json::Range kFriction{0.0, 10.0, ""};
constexpr json::Range kThrustMax{0.0, 1000.0, "m/s^2"};
constexpr json::Range kEdgeRestitution{0.0, 1.0, ""};
constexpr json::Range kCentralGravity{0.0, 1e6, "m^3/s^2"};
constexpr json::Range kCoreRadius{1e-3, 1e6, "m"};
constexpr json::Range kTolerance{0.0, 1.0, "m/s of play"};
constexpr json::Range kCoordinate{-1e12, 1e12, "m"};
constexpr std::size_t kMaxNameBytes = 64;
constexpr std::size_t kMaxDocumentSplineKnots = 64;  ///< each way: 1.3 us a look, of which a step takes one

SurfaceKind read_surface(const json::Value& value, json::Problems& problems) {
  if (value.is(json::Kind::kString)) {
    const std::string_view text = value.text();
    if (const auto kind = surface_from_text(text)) return *kind;
    const std::string hint =
        json::did_you_mean(text, {"spline", "natural_spline", "function", "biquadratic", "blended",
                                  "blended_document", "gauss", "document_spline"});
    problems.add(value, "is no kind of surface",
                 hint.empty() ? "spline, natural_spline or function; with the paper's equations biquadratic, "
                                "blended, blended_document, gauss or document_spline"
                              : hint);
  } else {
    problems.add(value, "the name of a surface is wanted", "spline, natural_spline or function");
  }
  return SurfaceKind::kSpline;
}

/// One of the texts that `from_text` knows; `wanted` lists them.
template <typename E, typename FromText>
void read_choice(const json::Fields& fields, std::string_view key, E& out, FromText from_text,
                 std::string wanted, json::Problems& problems) {
  const auto value = fields.find(key);
  if (!value) return;
  const std::optional<E> found = json::choice_of(*value, from_text);
  if (found) {
    out = *found;
  } else {
    problems.add(*value, "is none of its choices", std::move(wanted));
  }
}

/// What goes with the paper's equations and what does not.
void check_equations(const json::Value& physics, const state::Parameters& p, json::Problems& problems) {
  const bool is_exact = p.equations == state::Equations::kExact;
  const bool is_false_euler = p.method == state::Method::kFalseEuler;
  if (!is_exact && !is_false_euler) {
    problems.add(physics, "the paper's equations are integrated by its own method",
                 "add \"method\": \"false_euler\"");
  }
  if (is_exact && is_false_euler) {
    problems.add(physics, "false_euler goes with the paper's equations",
                 "add \"equations\": \"local_plane\" or \"as_printed\"");
  }
  if (!is_exact && p.tolerance > 0.0)
    problems.add(physics, "the paper's own method has steps of one length, whatever they err",
                 "leave tolerance out");
  if (!is_exact && p.central_gravity > 0.0) {
    problems.add(physics, "the paper's equations of the surface know no central gravity", "leave it out");
  }
  if (!is_exact && p.contact == state::SurfaceContact::kUnilateral) {
    problems.add(physics, "in the paper's equations a louse never leaves the surface", "take bilateral");
  }
}

state::Parameters read_physics(const json::Value& value, json::Problems& problems) {
  const json::Fields fields(value,
                            {"gravity", "drag", "friction", "thrust_max", "edge_restitution",
                             "central_gravity", "core_radius", "tolerance", "contact", "equations", "method"},
                            problems);
  state::Parameters result;
  result.gravity = fields.number_or("gravity", kGravity, result.gravity);
  result.drag = fields.number_or("drag", kDrag, result.drag);
  result.friction = fields.number_or("friction", kFriction, result.friction);
  result.thrust_max = fields.number_or("thrust_max", kThrustMax, result.thrust_max);
  result.edge_restitution = fields.number_or("edge_restitution", kEdgeRestitution, result.edge_restitution);
  // "+ 0.0" turns -0.0 into 0.0: the canonical text leaves both out, and must read back the same.
  result.central_gravity = fields.number_or("central_gravity", kCentralGravity, result.central_gravity) + 0.0;
  if (result.central_gravity > 0.0) {
    result.core_radius =
        fields.number_or("core_radius", kCoreRadius, physics::default_core_radius(result.central_gravity));
  } else if (const auto radius = fields.find("core_radius")) {
    problems.add(*radius, "there is no central gravity to have a core",
                 "leave it out, or add central_gravity");
  }
  result.tolerance = fields.number_or("tolerance", kTolerance, result.tolerance) + 0.0;
  read_choice(fields, "contact", result.contact, state::contact_from_text, "bilateral or unilateral",
              problems);
  read_choice(fields, "equations", result.equations, state::equations_from_text,
              "exact, local_plane or as_printed", problems);
  read_choice(fields, "method", result.method, state::method_from_text,
              "standard, cheap or precise; with the paper's equations false_euler", problems);
  check_equations(value, result, problems);
  if (result.contact == state::SurfaceContact::kUnilateral && result.central_gravity > 0.0) {
    problems.add(*fields.find("contact"), "flight knows no pull but gravity's",
                 "leave central_gravity out, or take bilateral");
  }
  return result;
}

/// Whether the surface and the terrain suit the paper's equations, or one of its surfaces the terrain.
void check_document(const json::Value& root, const MapDefinition& definition, json::Problems& problems) {
  const bool is_exact = definition.physics.equations == state::Equations::kExact;
  const std::string_view name = to_text(definition.surface);
  if (is_of_document(definition.surface) && is_exact) {
    problems.add(root, core::joined({"the surface ", name, " has no curvature for the exact equations"}),
                 "add \"physics\": {\"equations\": \"local_plane\", \"method\": \"false_euler\"}");
  }
  if (std::holds_alternative<TiledTerrain>(definition.terrain)) {
    if (!is_exact)
      problems.add(root, "the paper's equations don't run on a terrain that is read tile by tile");
    return;
  }
  if (!is_of_document(definition.surface)) return;
  const terrain::HeightGrid knots = knots_of(definition);
  if (definition.surface == SurfaceKind::kDocumentSpline &&
      std::max(knots.columns, knots.rows) > kMaxDocumentSplineKnots) {
    problems.add(root,
                 core::joined({"document_spline solves a row of knots at each look: at most ",
                               std::to_string(kMaxDocumentSplineKnots), " a side"}),
                 "natural_spline is the same surface, prepared once");
    return;
  }
  if (const auto surface = document::interpolate(interpolation_of(definition.surface), knots); !surface)
    problems.add(root, surface.error().text());
}

/// The domain the surface will have; a spline's last knot may lie an ulp off the function's square.
terrain::Rectangle domain_of(const MapDefinition& definition) {
  if (const auto* grid = std::get_if<terrain::HeightGrid>(&definition.terrain)) return grid->domain();
  if (const auto* tiled = std::get_if<TiledTerrain>(&definition.terrain))
    return tiled->heights->frame().domain();
  const auto& function = std::get<FunctionTerrain>(definition.terrain);
  if (definition.surface == SurfaceKind::kFunction) {
    return terrain::FunctionSurface(function.function, function.scale).domain();
  }
  return terrain::sample_function(function.function, function.scale, function.grid).domain();
}

}  // namespace

std::optional<MapDefinition> read_definition(const json::Value& root, const GridPlace& place,
                                             json::Problems& problems) {
  const json::Fields fields(
      root, {"name", "terrain", "surface", "edges", "physics", "spawns", "race", "forage", "hill"}, problems);
  MapDefinition result;
  if (const auto name = fields.demand("name")) {
    result.name = json::text_in(*name, 1, kMaxNameBytes, problems).value_or("");
  }
  const auto terrain_value =
      fields.demand("terrain", "{\"function\": ...}, {\"file\": ...} or {\"heights\": ...}");
  std::optional<TerrainDefinition> terrain;
  if (terrain_value) terrain = read_terrain(*terrain_value, place, result.ground_note, problems);
  if (terrain) result.terrain = std::move(*terrain);
  if (const auto surface = fields.find("surface")) {
    result.surface = read_surface(*surface, problems);
    if (terrain && result.surface == SurfaceKind::kFunction &&
        !std::holds_alternative<FunctionTerrain>(result.terrain)) {
      problems.add(*surface, "\"function\" needs a terrain that names a function", "take spline");
      result.surface = SurfaceKind::kSpline;
    }
    if (terrain && result.surface == SurfaceKind::kNaturalSpline &&
        std::holds_alternative<TiledTerrain>(result.terrain)) {
      problems.add(*surface, "natural ends need all heights at once, and this terrain is read tile by tile",
                   "take spline");
    }
  }
  if (const auto physics = fields.find("physics")) result.physics = read_physics(*physics, problems);
  if (terrain) check_document(root, result, problems);
  if (const auto edges = fields.find("edges"); edges && terrain) {
    result.physics.edges = read_edges(*edges, result, problems);
  }

  // Without a terrain, or with an overview, which may end an ulp off, spawn points are checked for all but
  // their place.
  const double anywhere = kCoordinate.max;
  const terrain::Rectangle domain = terrain && !std::holds_alternative<terrain::HeightGrid>(place)
                                        ? domain_of(result)
                                        : terrain::Rectangle{-anywhere, -anywhere, anywhere, anywhere};
  if (const auto spawns = fields.find("spawns")) {
    result.spawns = read_spawns(*spawns, domain, problems);
  } else {
    result.spawns = default_spawns(domain);
  }
  result.modes = read_modes(root, result, domain, problems);
  if (problems.count() != 0) return std::nullopt;
  return result;
}

}  // namespace woodlouse::map
