#include "web/core/ground.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "shared/json/object_text.h"
#include "shared/map/map_text.h"
#include "shared/map/spawns.h"
#include "shared/protocol/decode_map.h"
#include "shared/rules/climb.h"
#include "web/core/answer.h"
#include "web/core/bytes.h"

namespace woodlouse::web {
namespace {

Handles<std::shared_ptr<const map::Map>> grounds;

const std::vector<map::SpawnPoint>& spawns_of(const map::MapDefinition& map, state::Mode mode) {
  const bool has_own = mode == state::Mode::kRace && map.modes.race && !map.modes.race->spawns.empty();
  return has_own ? map.modes.race->spawns : map.spawns;
}

int opened(core::Expected<std::shared_ptr<const map::Map>> map) {
  return map ? static_cast<int>(open_ground(std::move(*map))) : refuse(map.error());
}

}  // namespace

Handle open_ground(std::shared_ptr<const map::Map> map) {
  assert(map != nullptr);
  return grounds.add(std::make_unique<std::shared_ptr<const map::Map>>(std::move(map)));
}

const std::shared_ptr<const map::Map>& ground(Handle handle) { return grounds.at(handle); }

/// The map of a definition (a map's file: maps/README.md), checked as the server checks it; grid files are
/// not looked for. 0: it is none, and the answer says why.
WOODLOUSE_EXPORT(ground_open) int ground_open(const char* text, std::size_t size) {
  return opened(map::parse_map(bytes_at(text, size), "the map", nullptr));
}

/// The map of a line of the wire, the message `map`, of big ones its overview. 0: as above.
WOODLOUSE_EXPORT(ground_open_line) int ground_open_line(const char* line, std::size_t size) {
  const auto message = protocol::decode_map(bytes_at(line, size));
  if (!message) return refuse({"the server's map", message.error().text, {}});
  if (message->is_overview && message->knots)
    return opened(map::parse_overview(message->definition, "the server's map", *message->knots));
  return opened(map::parse_map(message->definition, "the server's map", nullptr));
}

/// Whoever holds the map still has it: worlds, followers, recordings.
WOODLOUSE_EXPORT(ground_close) void ground_close(Handle handle) { grounds.close(handle); }

/// Answers with {"name", "hash", "domain": [x0, y0, x1, y1] (m), "edges": "walls", "wrap" or "open",
/// "central_gravity" (towards the origin, m^3/s^2; 0: none), "core_radius" (m), "climbs" (the slope that full
/// thrust climbs from rest), "equations", "method", "contact", "exact": false of an overview, from which
/// nothing may be computed}
WOODLOUSE_EXPORT(ground_facts) void ground_facts(Handle handle) {
  const map::Map& map = *ground(handle);
  const state::Parameters& physics = map.definition.physics;
  const terrain::Rectangle& domain = map.terrain->domain();
  json::ObjectText text(answer());
  text.text("name", map.definition.name).hash("hash", map.hash);
  text.array("domain", std::array{domain.x_min, domain.y_min, domain.x_max, domain.y_max},
             json::append_double);
  text.text("edges", to_text(physics.edges)).number("central_gravity", physics.central_gravity);
  text.number("core_radius", physics.core_radius)
      .number("climbs", rules::climbable_slope(physics))
      .text("equations", to_text(physics.equations));
  text.text("method", to_text(physics.method)).text("contact", to_text(physics.contact));
  text.boolean("exact", map.detail == map::Detail::kExact).end();
}

/// Answers with the canonical definition, JSON.
WOODLOUSE_EXPORT(ground_definition) void ground_definition(Handle handle) {
  answer() = ground(handle)->canonical;
}

/// Heights and gradients at columns x rows points (each at least 2) over the whole domain, row by row from
/// its south-western corner, into 3 * columns * rows floats: z [m], zx, zy.
WOODLOUSE_EXPORT(ground_grid)
void ground_grid(Handle handle, std::uint32_t columns, std::uint32_t rows, float* to) {
  assert(columns >= 2 && rows >= 2 && columns <= 4096 && rows <= 4096);
  bytes_at(reinterpret_cast<const char*>(to), std::size_t{columns} * rows * 3 * sizeof *to);
  const terrain::Terrain& terrain = *ground(handle)->terrain;
  const terrain::Rectangle& domain = terrain.domain();
  for (std::uint32_t row = 0; row < rows; ++row) {
    const double y = domain.y_min + (domain.y_max - domain.y_min) * (row / (rows - 1.0));
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double x = domain.x_min + (domain.x_max - domain.x_min) * (column / (columns - 1.0));
      const terrain::SurfaceSample sample = terrain.sample(x, y);
      *to++ = static_cast<float>(sample.z);
      *to++ = static_cast<float>(sample.zx);
      *to++ = static_cast<float>(sample.zy);
    }
  }
}

/// Where height [m] and gradient at a point stand, 3 doubles, until the next call; of a point outside of the
/// domain those of its edge. NaN where a coordinate is none.
WOODLOUSE_EXPORT(ground_sample) const double* ground_sample(Handle handle, double x, double y) {
  static std::array<double, 3> result;
  const terrain::Terrain& terrain = *ground(handle)->terrain;
  const terrain::Rectangle& domain = terrain.domain();
  if (std::isnan(x) || std::isnan(y)) {
    result.fill(std::numeric_limits<double>::quiet_NaN());
    return result.data();
  }
  const terrain::SurfaceSample sample =
      terrain.sample(std::clamp(x, domain.x_min, domain.x_max), std::clamp(y, domain.y_min, domain.y_max));
  result = {sample.z, sample.zx, sample.zy};
  return result.data();
}

/// A louse that begins there, of 104 bytes; false: there are not so many spawns. `mode`: 0 roam, 1 race, 2
/// forage, 3 hill.
WOODLOUSE_EXPORT(ground_spawn)
bool ground_spawn(Handle handle, std::uint32_t mode, std::uint32_t spawn, std::uint32_t id,
                  state::Louse* to) {
  assert(mode < state::kModes.size());
  bytes_at(reinterpret_cast<const char*>(to), sizeof *to);
  const std::vector<map::SpawnPoint>& spawns = spawns_of(ground(handle)->definition, state::kModes[mode]);
  if (spawn >= spawns.size()) return false;
  *to = map::louse_at(spawns[spawn], id);
  return true;
}

}  // namespace woodlouse::web
