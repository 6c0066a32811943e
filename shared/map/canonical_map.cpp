#include "shared/map/canonical_map.h"

#include <cassert>

#include "shared/core/stable_hash.h"
#include "shared/json/text.h"

namespace woodlouse::map {
namespace {

std::string_view to_text(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kSpline:
      return "spline";
    case SurfaceKind::kNaturalSpline:
      return "natural_spline";
    case SurfaceKind::kFunction:
      return "function";
  }
  assert(false);
  return {};
}

void append_pair(std::string& out, double x, double y) {
  out += '[';
  json::append_double(out, x);
  out += ',';
  json::append_double(out, y);
  out += ']';
}

void append_heights(std::string& out, const terrain::HeightGrid& grid) {
  out += "{\"origin\":";
  append_pair(out, grid.x_origin, grid.y_origin);
  out += ",\"spacing\":";
  append_pair(out, grid.dx, grid.dy);
  out += ",\"heights\":[";
  for (std::size_t j = 0; j < grid.rows; ++j) {
    out += j == 0 ? "[" : ",[";
    for (std::size_t i = 0; i < grid.columns; ++i) {
      if (i != 0) out += ',';
      json::append_double(out, grid.at(i, j));
    }
    out += ']';
  }
  out += "]}";
}

void append_tiled(std::string& out, const TiledTerrain& terrain) {
  out += "{\"file\":";
  json::append_string(out, terrain.file);
  out += ",\"scale\":";
  json::append_double(out, terrain.scale);
  out += ",\"fill_level\":";
  json::append_double(out, terrain.fill_level);
  out += ",\"storage\":\"tiles\",\"fingerprint\":\"" + core::to_hex(terrain.fingerprint) + "\"}";
}

void append_function(std::string& out, const FunctionTerrain& function) {
  out += "{\"function\":";
  json::append_string(out, terrain::to_text(function.function));
  out += ",\"grid\":" + std::to_string(function.grid) + ",\"scale\":";
  json::append_double(out, function.scale);
  out += '}';
}

void append_physics(std::string& out, const state::Parameters& physics) {
  out += "{\"gravity\":";
  json::append_double(out, physics.gravity);
  out += ",\"drag\":";
  json::append_double(out, physics.drag);
  out += ",\"friction\":";
  json::append_double(out, physics.friction);
  out += ",\"thrust_max\":";
  json::append_double(out, physics.thrust_max);
  out += ",\"edge_restitution\":";
  json::append_double(out, physics.edge_restitution);
  // What few maps have is left out where it is the default.
  const state::Parameters usual;
  if (physics.central_gravity != usual.central_gravity) {
    out += ",\"central_gravity\":";
    json::append_double(out, physics.central_gravity);
  }
  if (physics.contact != usual.contact) {
    out += ",\"contact\":";
    json::append_string(out, state::to_text(physics.contact));
  }
  if (physics.method != usual.method) {
    out += ",\"method\":";
    json::append_string(out, state::to_text(physics.method));
  }
  out += '}';
}

}  // namespace

terrain::HeightGrid knots_of(const MapDefinition& definition) {
  if (const auto* grid = std::get_if<terrain::HeightGrid>(&definition.terrain)) return *grid;
  assert(!std::holds_alternative<TiledTerrain>(definition.terrain));
  const auto& function = std::get<FunctionTerrain>(definition.terrain);
  return terrain::sample_function(function.function, function.scale, function.grid);
}

std::string canonical_text(const MapDefinition& definition) {
  std::string out = "{\"name\":";
  json::append_string(out, definition.name);
  out += ",\"terrain\":";
  if (definition.surface == SurfaceKind::kFunction) {
    append_function(out, std::get<FunctionTerrain>(definition.terrain));
  } else if (const auto* tiled = std::get_if<TiledTerrain>(&definition.terrain)) {
    append_tiled(out, *tiled);
  } else {
    append_heights(out, knots_of(definition));
  }
  out += ",\"surface\":";
  json::append_string(out, to_text(definition.surface));
  if (definition.physics.edges != state::Parameters{}.edges) {
    out += ",\"edges\":";
    json::append_string(out, state::to_text(definition.physics.edges));
  }
  out += ",\"physics\":";
  append_physics(out, definition.physics);
  out += ",\"spawns\":[";
  for (std::size_t k = 0; k < definition.spawns.size(); ++k) {
    out += k == 0 ? "{\"position\":" : ",{\"position\":";
    append_pair(out, definition.spawns[k].position.x, definition.spawns[k].position.y);
    out += ",\"heading\":";
    append_pair(out, definition.spawns[k].heading.x, definition.spawns[k].heading.y);
    if (definition.spawns[k].speed != 0.0) {
      out += ",\"speed\":";
      json::append_double(out, definition.spawns[k].speed);
    }
    out += '}';
  }
  out += "]}";
  return out;
}

}  // namespace woodlouse::map
