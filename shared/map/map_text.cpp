#include "shared/map/map_text.h"

#include <cassert>
#include <string>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/document/game.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/map/canonical_map.h"
#include "shared/map/document_surface.h"
#include "shared/map/map_reader.h"

namespace woodlouse::map {
namespace {

/// heights within rows within heights within terrain within the map, and some to spare.
constexpr std::size_t kMaxDepth = 8;
/// Every height, every row, and the rest of the map.
constexpr std::size_t kMaxValues = 2 * kMaxKnots + 100'000;

terrain::SplineEnds ends_of(const MapDefinition& definition) {
  if (definition.physics.edges == state::Edges::kWrap) return terrain::SplineEnds::kPeriodic;
  return definition.surface == SurfaceKind::kNaturalSpline ? terrain::SplineEnds::kNatural
                                                           : terrain::SplineEnds::kNotAKnot;
}

/// One of the paper's surfaces, and its steps.
void lay_document_surface(Map& map, const MapDefinition& definition) {
  auto made = document::interpolate(interpolation_of(definition.surface), knots_of(definition));
  assert(made.has_value());  // the reader has tried
  const auto surface = std::make_shared<const document::AnySurface>(std::move(*made));
  map.terrain =
      std::make_shared<const terrain::Terrain>(terrain::SharedSurface(document::as_terrain(surface)));
  map.make_steps = [surface](const physics::StepRules& rules) {
    return document::make_game_steps(*surface, rules);
  };
}

std::shared_ptr<const Map> build(MapDefinition definition, std::string canonical) {
  auto map = std::make_shared<Map>();
  map->canonical = std::move(canonical);
  map->hash = core::stable_hash(map->canonical);
  if (is_of_document(definition.surface)) {
    lay_document_surface(*map, definition);
  } else if (definition.surface == SurfaceKind::kFunction) {
    const auto& function = std::get<FunctionTerrain>(definition.terrain);
    map->terrain =
        std::make_shared<const terrain::Terrain>(terrain::FunctionSurface(function.function, function.scale));
  } else if (const auto* tiled = std::get_if<TiledTerrain>(&definition.terrain)) {
    terrain::TiledBSplineOptions options;
    options.no_data = terrain::NoDataPolicy::kFill;
    options.fill_level = tiled->fill_level;
    map->terrain = std::make_shared<const terrain::Terrain>(terrain::TiledGround(tiled->heights, options));
  } else {
    const terrain::HeightGrid knots = knots_of(definition);
    const auto plane = terrain::plane_through(knots);
    map->terrain = std::make_shared<const terrain::Terrain>(
        plane ? terrain::Terrain(*plane)
              : terrain::Terrain(terrain::BicubicSpline(knots, ends_of(definition))));
  }
  if (definition.physics.equations != state::Equations::kExact && !map->make_steps) {
    map->make_steps = [terrain = map->terrain](const physics::StepRules& rules) {
      return document::make_game_steps(*terrain, rules);
    };
  }
  map->definition = std::move(definition);
  return map;
}

/// Whether a function is only named where it is stepped on itself: a canonical text never has one sampled,
/// and a few bytes of such a text would ask for millions of knots.
bool samples_function(const json::Value& root) {
  const auto terrain = root.find("terrain");
  const auto surface = root.find("surface");
  const bool is_function = surface && json::choice_of(*surface, surface_from_text) == SurfaceKind::kFunction;
  return terrain && terrain->find("function") && !is_function;
}

enum class Form { kAny, kCanonical };

constexpr const char* kNotCanonical =
    "is not a map as a program writes it: another text, or in another order";
constexpr const char* kNotCanonicalHint = "it was altered, or written by something else";

constexpr const char* kSomethingElse =
    "a map is a JSON object; of an elevation file one is made: woodlouse-server make-map FILE --out MAP.json";

/// It does not even begin as a map does.
bool is_something_else(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] != '{';
}

std::optional<MapDefinition> read(std::string_view text, const GridPlace& place, Form form,
                                  json::Problems& problems) {
  if (text.size() > kMaxMapBytes) {
    problems.add(0, {}, core::joined({"longer than ", std::to_string(kMaxMapBytes >> 20), " MiB"}));
    return std::nullopt;
  }
  const auto document = json::parse_file(text, problems.source(), {kMaxDepth, kMaxValues});
  if (!document) {
    core::Error error = document.error();
    if (is_something_else(text)) error.hint = kSomethingElse;
    problems.add(std::move(error));
    return std::nullopt;
  }
  if (form == Form::kCanonical && samples_function(document->root())) {
    problems.add(0, {}, kNotCanonical, kNotCanonicalHint);
    return std::nullopt;
  }
  return read_definition(document->root(), place, problems);
}

}  // namespace

core::Expected<std::shared_ptr<const Map>> parse_map(std::string_view text, std::string_view source,
                                                     const GridFolder* folder) {
  json::Problems problems{std::string(source)};
  std::optional<MapDefinition> definition = read(text, folder, Form::kAny, problems);
  if (!definition) return tl::unexpected(problems.errors().front());
  std::string canonical = canonical_text(*definition);
  return build(std::move(*definition), std::move(canonical));
}

core::Expected<std::shared_ptr<const Map>> parse_canonical_map(std::string_view text,
                                                               std::string_view source) {
  json::Problems problems{std::string(source)};
  std::optional<MapDefinition> definition =
      read(text, static_cast<const GridFolder*>(nullptr), Form::kCanonical, problems);
  if (!definition) return tl::unexpected(problems.errors().front());
  std::string canonical = canonical_text(*definition);
  if (canonical != text) return core::fail(std::string(source), kNotCanonical, kNotCanonicalHint);
  return build(std::move(*definition), std::move(canonical));
}

core::Expected<std::shared_ptr<const Map>> parse_overview(std::string_view text, std::string_view source,
                                                          const terrain::HeightGrid& overview) {
  json::Problems problems{std::string(source)};
  std::optional<MapDefinition> definition = read(text, overview, Form::kAny, problems);
  if (!definition) return tl::unexpected(problems.errors().front());
  auto map = std::make_shared<Map>();
  map->detail = Detail::kOverview;
  map->canonical = text;
  map->hash = core::stable_hash(text);
  map->terrain = std::make_shared<const terrain::Terrain>(terrain::BicubicSpline(overview));
  map->definition = std::move(*definition);
  return map;
}

std::vector<core::Error> check_map(std::string_view text, std::string_view source, const GridFolder* folder) {
  json::Problems problems{std::string(source)};
  read(text, folder, Form::kAny, problems);
  return std::move(problems).told();
}

}  // namespace woodlouse::map
