#include "shared/map/terrain_reader.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

#include "shared/core/joined.h"
#include "shared/elevation/ground.h"
#include "shared/map/float_grid_reader.h"
#include "shared/map/map_text.h"
#include "shared/map/opened_grid.h"
#include "shared/map/terrain_ranges.h"

namespace woodlouse::map {
namespace {

using terrain::HeightGrid;

constexpr json::Range kFunctionScale{0.1, 1e5, "m"};
constexpr std::uint64_t kMinFunctionGrid = 2;
constexpr std::uint64_t kMaxFunctionGrid = 999;

FunctionTerrain read_function(const json::Value& value, const json::Value& name, json::Problems& problems) {
  const json::Fields fields(value, {"function", "grid", "scale"}, problems);
  FunctionTerrain result;
  if (!name.is(json::Kind::kString)) {
    problems.add(name, "the name of a function is wanted",
                 "parabolic_pot, wavy_pot, volcano, hills or waves");
  } else if (const auto function = terrain::function_from_text(name.text())) {
    result.function = *function;
  } else {
    const std::string hint =
        json::did_you_mean(name.text(), {"parabolic_pot", "wavy_pot", "volcano", "hills", "waves"});
    problems.add(name, "is no function we have",
                 hint.empty() ? "parabolic_pot, wavy_pot, volcano, hills or waves" : hint);
  }
  if (const auto grid = fields.find("grid")) {
    const auto side = json::integer_in(*grid, kMinFunctionGrid, kMaxFunctionGrid, problems);
    result.grid = static_cast<std::size_t>(side.value_or(result.grid));
  }
  result.scale = fields.number_or("scale", kFunctionScale, result.scale);
  return result;
}

/// The path of a grid file, if it stays in the map's folder.
std::optional<std::string> grid_path(const json::Value& name, const GridFolder* folder,
                                     json::Problems& problems) {
  const std::optional<std::string> text = json::text_in(name, 1, 255, problems);
  if (!text) return std::nullopt;
  if (folder == nullptr) {
    problems.add(name, "a map that comes without a folder can't name a file", "send its heights in place");
    return std::nullopt;
  }
  core::Expected<std::string> path = folder->find(*text);
  if (path) return std::move(*path);
  problems.add(name, path.error().what, path.error().hint);
  return std::nullopt;
}

#ifndef WOODLOUSE_FREESTANDING
/// A grid of text, its middle laid at the origin: real-world coordinates would cost digits and help nobody.
std::optional<HeightGrid> read_text_grid(const json::Value& value, const json::Value& name,
                                         const GridFolder& folder, const std::string& path, std::string& note,
                                         json::Problems& problems) {
  const json::Fields fields(value, {"file", "scale", "unit", "rim", "fill_level"}, problems);
  const elevation::GroundOptions options = read_ground_options(fields, problems);
  const core::Expected<std::string> text = folder.read_text(path);
  if (!text) {
    problems.add(name, text.error().text());
    return std::nullopt;
  }
  std::optional<elevation::FileGrid> file = parse_grid_text(*text, path, problems);
  if (!file) return std::nullopt;
  auto ground = elevation::make_ground(std::move(*file), options, path);
  if (!ground) {
    problems.add(std::move(ground.error()));
    return std::nullopt;
  }
  note = std::move(ground->note);
  return std::move(ground->grid);
}
#endif

/// In place of a big map's heights those of its overview. How steep it is is nobody's business: nothing runs
/// on it.
std::optional<TerrainDefinition> read_overview(const json::Value& value, const HeightGrid& overview,
                                               json::Problems& problems) {
  const bool is_whole = overview.columns >= kMinKnotsEachWay && overview.rows >= kMinKnotsEachWay &&
                        overview.heights.size() == overview.columns * overview.rows;
  const bool is_placed = within(overview.dx, kSpacing) && within(overview.dy, kSpacing) &&
                         within(overview.x_origin, kOrigin) && within(overview.y_origin, kOrigin);
  const bool is_flat_enough = std::all_of(overview.heights.begin(), overview.heights.end(),
                                          [](double height) { return within(height, kHeight); });
  if (is_whole && is_placed && is_flat_enough) return overview;
  problems.add(value, "the overview that came with it has a number out of range",
               "use a client of the server's version");
  return std::nullopt;
}

std::optional<TerrainDefinition> read_grid_file(const json::Value& value, const json::Value& name,
                                                const GridPlace& place, std::string& note,
                                                json::Problems& problems) {
  if (const auto* overview = std::get_if<HeightGrid>(&place))
    return read_overview(value, *overview, problems);
  const GridFolder* folder = std::get<const GridFolder*>(place);
  const auto path = grid_path(name, folder, problems);
  if (!path) return std::nullopt;
#ifdef WOODLOUSE_FREESTANDING
  static_cast<void>(note);
  assert(false);  // where there are no files there is no folder either
  return std::nullopt;
#else
  if (is_float_grid(*path) || is_srtm_tile(*path))
    return read_float_grid(value, *folder, *path, note, problems);
  if (auto grid = read_text_grid(value, name, *folder, *path, note, problems)) return std::move(*grid);
  return std::nullopt;
#endif
}

void read_rows(const json::Value& value, double scale, HeightGrid& grid, json::Problems& problems) {
  const std::vector<json::Value> rows = value.children();
  if (!value.is(json::Kind::kArray) || rows.size() < kMinKnotsEachWay) {
    problems.add(value, "at least 4 rows of heights are wanted",
                 "[[south row, west to east], ..., [north row]]");
    return;
  }
  grid.rows = rows.size();
  grid.columns = rows.front().size();
  if (!rows.front().is(json::Kind::kArray) || grid.columns < kMinKnotsEachWay) {
    problems.add(rows.front(), "a row of at least 4 heights is wanted");
    return;
  }
  // Of rows that are not alike their product may say anything.
  grid.heights.reserve(
      static_cast<std::size_t>(std::min(std::uint64_t{grid.rows} * grid.columns, std::uint64_t{kMaxKnots})));
  for (const json::Value& row : rows) {
    const std::vector<json::Value> heights = row.children();
    if (!row.is(json::Kind::kArray)) {
      problems.add(row, "a row of heights is wanted");
    } else if (heights.size() != grid.columns) {
      problems.add(row, core::joined({std::to_string(heights.size()), " heights, the first row has ",
                                      std::to_string(grid.columns)}));
    }
    for (const json::Value& height : heights) {
      grid.heights.push_back(scale * json::number_in(height, kHeight, problems).value_or(0.0));
    }
  }
}

HeightGrid read_inline(const json::Value& value, const json::Value& heights, json::Problems& problems) {
  const json::Fields fields(value, {"origin", "spacing", "heights", "scale"}, problems);
  const double scale = fields.number_or("scale", kGridScale, 1.0);
  HeightGrid grid;
  core::Vec2 spacing{1.0, 1.0};
  if (const auto found = fields.demand("spacing", "metres between knots: a number or [dx, dy]")) {
    if (found->is(json::Kind::kArray)) {
      spacing = json::pair_in(*found, kSpacing, problems).value_or(spacing);
    } else {
      spacing.x = spacing.y = json::number_in(*found, kSpacing, problems).value_or(1.0);
    }
  }
  grid.dx = scale * spacing.x;
  grid.dy = scale * spacing.y;
  read_rows(heights, scale, grid, problems);
  if (const auto origin = fields.find("origin")) {
    const core::Vec2 corner = json::pair_in(*origin, kOrigin, problems).value_or(core::Vec2{});
    grid.x_origin = scale * corner.x;
    grid.y_origin = scale * corner.y;
  } else if (grid.columns != 0 && grid.rows != 0) {
    grid.x_origin = -0.5 * (static_cast<double>(grid.columns - 1) * grid.dx);
    grid.y_origin = -0.5 * (static_cast<double>(grid.rows - 1) * grid.dy);
  }
  return grid;
}

/// What only shows once the scale is applied.
void check_grid(const json::Value& value, const HeightGrid& grid, json::Problems& problems) {
  if (!within(grid.dx, kSpacing) || !within(grid.dy, kSpacing)) {
    problems.add(value, "knots less than 1 mm or more than 1000 km apart", "choose another scale");
    return;
  }
  if (!within(grid.x_origin, kOrigin) || !within(grid.y_origin, kOrigin)) {
    problems.add(value, "the origin is more than 10000 km off", "choose another scale or origin");
  }
  for (std::size_t k = 0; k < grid.heights.size(); ++k) {
    const std::size_t i = k % grid.columns;
    const std::size_t j = k / grid.columns;
    const double z = grid.heights[k];
    const double east = i + 1 < grid.columns ? std::abs(grid.heights[k + 1] - z) / grid.dx : 0.0;
    const double north = j + 1 < grid.rows ? std::abs(grid.heights[k + grid.columns] - z) / grid.dy : 0.0;
    const bool is_high = !within(z, kHeight);
    if (!is_high && east <= kMaxSlope && north <= kMaxSlope) continue;
    problems.add(
        value,
        core::joined({"column ", std::to_string(i + 1), " from the west, row ", std::to_string(j + 1),
                      " from the south: ",
                      is_high ? "a height past 1000 km" : "steeper than 100 m a metre to the next knot"}),
        is_high ? "choose another scale" : "smooth the heights, or check their unit against the spacing's");
    return;
  }
}

}  // namespace

std::optional<TerrainDefinition> read_terrain(const json::Value& value, const GridPlace& place,
                                              std::string& note, json::Problems& problems) {
  const std::size_t problems_before = problems.count();
  const auto function = value.find("function");
  const auto file = value.find("file");
  const auto heights = value.find("heights");
  const int ways = (function ? 1 : 0) + (file ? 1 : 0) + (heights ? 1 : 0);
  if (ways != 1) {
    const json::Fields fields(value,
                              {"function", "grid", "scale", "file", "fill_level", "storage", "fingerprint",
                               "unit", "rim", "corner", "origin", "spacing", "heights"},
                              problems);
    if (value.is(json::Kind::kObject)) {
      problems.add(value, core::joined({"exactly one of function, file and heights is wanted, not ",
                                        std::to_string(ways)}));
    }
    return std::nullopt;
  }
  std::optional<TerrainDefinition> result;
  if (function) {
    result = read_function(value, *function, problems);
  } else {
    result =
        file ? read_grid_file(value, *file, place, note, problems) : read_inline(value, *heights, problems);
    if (!result || problems.count() != problems_before || problems.is_full()) return std::nullopt;
    const auto* grid = std::get_if<HeightGrid>(&*result);
    if (grid != nullptr && !std::holds_alternative<HeightGrid>(place)) {
      if (grid->columns * grid->rows > kMaxKnots) {
        problems.add(value, core::joined({"more than ", std::to_string(kMaxKnots), " knots"}),
                     "a float grid (.flt) of that size is stepped on from its file");
      } else {
        check_grid(value, *grid, problems);
      }
    }
  }
  if (problems.count() != problems_before || problems.is_full()) return std::nullopt;
  return result;
}

}  // namespace woodlouse::map
