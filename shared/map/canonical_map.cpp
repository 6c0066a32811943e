#include "shared/map/canonical_map.h"

#include <array>
#include <cassert>
#include <utility>

#include "shared/json/object_text.h"
#include "shared/map/modes_reader.h"
#include "shared/map/spawns.h"
#include "shared/physics/central_gravity.h"

namespace woodlouse::map {
namespace {

void add_heights(json::ObjectText& terrain, const terrain::HeightGrid& grid) {
  terrain.pair("origin", {grid.x_origin, grid.y_origin}).pair("spacing", {grid.dx, grid.dy});
  terrain.value("heights", [&](std::string& out) { json::append_rows(out, grid.heights, grid.columns); });
}

void add_tiled(json::ObjectText& terrain, const TiledTerrain& tiled) {
  terrain.text("file", tiled.file).number("scale", tiled.scale).number("fill_level", tiled.fill_level);
  if (tiled.is_in_degrees) terrain.text("unit", "degrees");
  if (tiled.corner) terrain.pair("corner", *tiled.corner);
  terrain.text("storage", "tiles").hash("fingerprint", tiled.fingerprint);
}

void add_function(json::ObjectText& terrain, const FunctionTerrain& function) {
  terrain.text("function", terrain::to_text(function.function));
  terrain.integer("grid", function.grid).number("scale", function.scale);
}

void add_terrain(json::ObjectText& terrain, const MapDefinition& definition) {
  if (definition.surface == SurfaceKind::kFunction) {
    add_function(terrain, std::get<FunctionTerrain>(definition.terrain));
  } else if (const auto* tiled = std::get_if<TiledTerrain>(&definition.terrain)) {
    add_tiled(terrain, *tiled);
  } else {
    add_heights(terrain, knots_of(definition));
  }
}

void add_physics(json::ObjectText& text, const state::Parameters& physics) {
  text.number("gravity", physics.gravity).number("drag", physics.drag).number("friction", physics.friction);
  text.number("thrust_max", physics.thrust_max).number("edge_restitution", physics.edge_restitution);
  // What few maps have is left out where it is the default.
  const state::Parameters usual;
  if (physics.central_gravity != usual.central_gravity)
    text.number("central_gravity", physics.central_gravity);
  if (physics.central_gravity > 0.0 &&
      physics.core_radius != physics::default_core_radius(physics.central_gravity))
    text.number("core_radius", physics.core_radius);
  if (physics.tolerance != usual.tolerance) text.number("tolerance", physics.tolerance);
  if (physics.contact != usual.contact) text.text("contact", state::to_text(physics.contact));
  if (physics.equations != usual.equations) text.text("equations", state::to_text(physics.equations));
  if (physics.method != usual.method) text.text("method", state::to_text(physics.method));
}

constexpr std::array<std::pair<SurfaceKind, std::string_view>, 8> kSurfaces = {{
    {SurfaceKind::kSpline, "spline"},
    {SurfaceKind::kNaturalSpline, "natural_spline"},
    {SurfaceKind::kFunction, "function"},
    {SurfaceKind::kBiquadratic, "biquadratic"},
    {SurfaceKind::kBlended, "blended"},
    {SurfaceKind::kBlendedDocument, "blended_document"},
    {SurfaceKind::kGauss, "gauss"},
    {SurfaceKind::kDocumentSpline, "document_spline"},
}};

}  // namespace

std::string_view to_text(SurfaceKind kind) {
  const auto& [own, text] = kSurfaces[static_cast<std::size_t>(kind)];
  assert(own == kind);
  return text;
}

std::optional<SurfaceKind> surface_from_text(std::string_view text) {
  for (const auto& [kind, name] : kSurfaces) {
    if (name == text) return kind;
  }
  return std::nullopt;
}

terrain::HeightGrid knots_of(const MapDefinition& definition) {
  if (const auto* grid = std::get_if<terrain::HeightGrid>(&definition.terrain)) return *grid;
  assert(!std::holds_alternative<TiledTerrain>(definition.terrain));
  const auto& function = std::get<FunctionTerrain>(definition.terrain);
  return terrain::sample_function(function.function, function.scale, function.grid);
}

std::string canonical_text(const MapDefinition& definition) {
  std::string out;
  json::ObjectText text(out);
  text.text("name", definition.name);
  text.object("terrain", [&](json::ObjectText& terrain) { add_terrain(terrain, definition); });
  text.text("surface", to_text(definition.surface));
  if (definition.physics.edges != state::Parameters{}.edges)
    text.text("edges", state::to_text(definition.physics.edges));
  text.object("physics", [&](json::ObjectText& physics) { add_physics(physics, definition.physics); });
  add_modes(text, definition.modes);
  add_spawns(text, definition.spawns);  // the last: scenarios put others in their place
  text.end();
  return out;
}

}  // namespace woodlouse::map
