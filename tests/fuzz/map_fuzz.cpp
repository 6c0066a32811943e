// The map loader: a text is a map that its canonical text gives back bit for bit and that lice can be played
// on, or a bounded list of problems, each with its place.
//
// Input: the map's text. Grid files are looked for in tests/fuzz/grids.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "shared/core/stable_hash.h"
#include "shared/json/document.h"
#include "shared/map/canonical_map.h"
#include "shared/map/grid_folder_file.h"
#include "shared/map/map_file.h"
#include "shared/map/map_reader.h"
#include "shared/match/match.h"
#include "tests/fuzz/map_size.h"
#include "tests/fuzz/property.h"

using namespace woodlouse;
using fuzz::demand;
using fuzz::demand_readable;
using fuzz::same_bits;

namespace {

const map::DiskFolder kGrids(std::filesystem::path(WOODLOUSE_SOURCE_DIR) / "tests" / "fuzz" / "grids");

/// Everything that is wrong, not only the first.
void check_problems(std::string_view text) {
  const auto document = json::parse_file(text, "map.json", {8, 100'000});
  if (!document) return;
  json::Problems problems("map.json");
  const auto definition = map::read_definition(document->root(), &kGrids, problems);
  demand(definition.has_value() == (problems.count() == 0), "a map is refused for a reason");
  demand(problems.count() <= json::Problems::kMaxProblems, "the list of problems is bounded");
  for (const core::Error& error : problems.errors()) {
    demand(!error.where.empty(), "an error names its place", error.what);
    demand_readable(error.text());
  }
}

void check_same(const terrain::HeightGrid& a, const terrain::HeightGrid& b) {
  demand(a.columns == b.columns && a.rows == b.rows, "the grid reads back in its size");
  demand(same_bits(a.dx, b.dx) && same_bits(a.dy, b.dy) && same_bits(a.x_origin, b.x_origin) &&
             same_bits(a.y_origin, b.y_origin),
         "the grid reads back in its place");
  demand(std::equal(a.heights.begin(), a.heights.end(), b.heights.begin(), b.heights.end(), same_bits),
         "the heights read back bit for bit");
}

void check_same(const state::Parameters& a, const state::Parameters& b) {
  demand(same_bits(a.gravity, b.gravity) && same_bits(a.drag, b.drag) && same_bits(a.friction, b.friction) &&
             same_bits(a.thrust_max, b.thrust_max) && same_bits(a.edge_restitution, b.edge_restitution) &&
             same_bits(a.central_gravity, b.central_gravity) && a.contact == b.contact &&
             a.method == b.method,
         "the physics reads back bit for bit");
}

void check_same(const map::SpawnPoint& a, const map::SpawnPoint& b) {
  demand(same_bits(a.position.x, b.position.x) && same_bits(a.position.y, b.position.y) &&
             same_bits(a.heading.x, b.heading.x) && same_bits(a.heading.y, b.heading.y) &&
             same_bits(a.speed, b.speed),
         "a spawn point reads back bit for bit");
}

/// What clients and recordings get is the map that was played.
void check_canonical(const map::Map& map) {
  const bool is_tiled = std::holds_alternative<map::TiledTerrain>(map.definition.terrain);
  const auto again = map::parse_map(map.canonical, "canonical", is_tiled ? &kGrids : nullptr);
  demand(again.has_value(), "the canonical text is a map", again ? "" : again.error().text());
  demand((*again)->canonical == map.canonical && (*again)->hash == map.hash, "the canonical text is its own");
  const map::MapDefinition& a = map.definition;
  const map::MapDefinition& b = (*again)->definition;
  demand(a.name == b.name && a.surface == b.surface, "name and surface read back");
  if (is_tiled) {
    demand(std::get<map::TiledTerrain>(a.terrain).fingerprint ==
               std::get<map::TiledTerrain>(b.terrain).fingerprint,
           "a grid file's fingerprint reads back");
  } else {
    check_same(map::knots_of(a), map::knots_of(b));
  }
  check_same(a.physics, b.physics);
  demand(a.spawns.size() == b.spawns.size(), "the spawn points read back");
  for (std::size_t k = 0; k < a.spawns.size(); ++k) check_same(a.spawns[k], b.spawns[k]);
}

/// A louse pushed about for a moment stays on the map and finite.
void check_play(const std::shared_ptr<const map::Map>& map) {
  const terrain::Rectangle domain = map->terrain->domain();
  match::Match match(map, {60, 1});
  const match::PlayerId player = match.join();
  constexpr int kTicks = 4;
  for (int tick = 0; tick < kTicks; ++tick) {
    match::Input input;
    input.player = player;
    input.seq = static_cast<std::uint32_t>(tick);
    input.thrust = {state::ThrustKind::kMapVector, {0.5, tick % 2 == 0 ? 0.25 : -0.75}};
    match.file(input);
    match.advance();
    const state::Louse& louse = *match.world().find(player);
    for (const double value :
         {louse.position.x, louse.position.y, louse.velocity.x, louse.velocity.y, louse.heading.x,
          louse.heading.y, louse.flight_z, louse.flight_vz, louse.distance}) {
      demand(std::isfinite(value), "a louse's state stays finite", map->canonical);
    }
    demand(domain.contains(louse.position.x, louse.position.y), "a louse stays on the map", map->canonical);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (!fuzz::is_quick_map(text)) return 0;
  check_problems(text);
  const auto map = map::parse_map(text, "map.json", &kGrids);
  if (!map) {
    demand(!map.error().where.empty(), "an error names its place", map.error().what);
    demand_readable(map.error().text());
    return 0;
  }
  for (const map::SpawnPoint& spawn : (*map)->definition.spawns) {
    demand((*map)->terrain->domain().contains(spawn.position.x, spawn.position.y), "lice start on the map");
    demand(std::abs(core::dot(spawn.heading, spawn.heading) - 1.0) < 1e-12, "a heading is a unit vector");
  }
  check_canonical(**map);
  check_play(*map);
  return 0;
}
