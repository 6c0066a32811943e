#include "bench/lab/problems/surface_choice.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <utility>
#include <variant>

#include "bench/lab/problems/names.h"
#include "shared/map/canonical_map.h"
#include "shared/map/flt_grid_file.h"
#include "shared/map/map_file.h"

namespace woodlouse::lab {
namespace {

std::string surface_names() { return "function " + names_of(document::kInterpolations); }

core::Expected<document::AnySurface> of_float_grid(const SurfaceOptions& options) {
  if (options.surface != "bspline") {
    return core::fail(options.map, "a float grid is read tile by tile", "take --surface bspline");
  }
  auto grid = map::FltGrid::open(options.map);
  if (!grid) return tl::unexpected(grid.error());
  const terrain::GridFrame frame = (*grid)->frame();
  if (frame.columns < 4 || frame.rows < 4) return core::fail(options.map, "needs 4 knots each way");
  return document::AnySurface(std::in_place_type<terrain::TiledBSpline>, std::move(*grid));
}

core::Expected<document::AnySurface> of_map(const SurfaceOptions& options,
                                            std::optional<document::Interpolation> interpolation) {
  const auto loaded = map::load_map(options.map);
  if (!loaded) return tl::unexpected(loaded.error());
  const map::MapDefinition& definition = (*loaded)->definition;
  if (const auto* tiled = std::get_if<map::TiledTerrain>(&definition.terrain)) {
    if (interpolation == document::Interpolation::kBSpline) {
      return document::AnySurface(std::in_place_type<terrain::TiledBSpline>, tiled->heights);
    }
    return core::fail(options.map, "its heights are not read whole", "take --surface bspline");
  }
  if (interpolation) return document::interpolate(*interpolation, map::knots_of(definition));
  if (const auto* function = std::get_if<map::FunctionTerrain>(&definition.terrain)) {
    return document::AnySurface(terrain::FunctionSurface(function->function, function->scale));
  }
  return core::fail(options.map, "its terrain is a grid, no function", "take --surface not_a_knot");
}

}  // namespace

void add_surface_options(CLI::App& app, SurfaceOptions& options, MapOption map) {
  app.add_option("--surface", options.surface, surface_names())->required();
  CLI::Option* function = app.add_option("--function", options.function, names_of(terrain::kFunctionNames))
                              ->capture_default_str();
  CLI::Option* grid = app.add_option("--grid", options.grid, "2 G + 1 knots a side on [-1, 1]")
                          ->check(CLI::Range(2, 2000))
                          ->capture_default_str();
  if (map == MapOption::kOffered) {
    app.add_option("--map", options.map, "a map file instead, or an ESRI float grid (.flt)")
        ->check(CLI::ExistingFile)
        ->excludes(function)
        ->excludes(grid);
  }
}

core::Expected<document::AnySurface> make_surface(const SurfaceOptions& options) {
  const auto interpolation = document::interpolation_from_text(options.surface);
  const bool is_function = options.surface == "function";
  if (!interpolation && !is_function) {
    return core::fail("--surface", "there is no \"" + options.surface + "\"", "one of: " + surface_names());
  }
  if (!options.map.empty()) {
    if (std::filesystem::path(options.map).extension() == ".flt") return of_float_grid(options);
    return of_map(options, interpolation);
  }
  const auto function = function_named(options.function);
  if (!function) return tl::unexpected(function.error());
  if (is_function) return document::AnySurface(terrain::FunctionSurface(*function, 1.0));
  return document::interpolate(*interpolation, terrain::sample_function(*function, 1.0, options.grid));
}

}  // namespace woodlouse::lab
