#include "server/commands/map_crop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/map/float_grid_reader.h"
#include "shared/map/grid_folder_file.h"
#include "shared/map/height_survey.h"
#include "shared/map/map_text.h"
#include "shared/map/opened_grid.h"
#include "shared/map/terrain_ranges.h"

namespace woodlouse::server {
namespace {

/// Knots first .. first + count - 1.
struct Knots {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// Those of `count` from `origin` on that lie within low .. high, a part of the grid. A coordinate that was
/// rounded where somebody read it off still means its knot.
Knots knots_within(double low, double high, double origin, double step, std::size_t count) {
  const double last = static_cast<double>(count - 1);
  const double begin = std::clamp(std::ceil((low - origin) / step - 1e-3), 0.0, last);
  const double end = std::clamp(std::floor((high - origin) / step + 1e-3), 0.0, last);
  if (!(begin <= end)) return {};
  return {static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin) + 1};
}

/// Both to a millimetre, in degrees to a centimetre.
std::string place(double x, double y, bool is_in_degrees) {
  const double digits = is_in_degrees ? 1e7 : 1e3;
  std::string text;
  json::append_double(text, std::round(x * digits) / digits);
  text += ',';
  json::append_double(text, std::round(y * digits) / digits);
  return text;
}

core::Expected<map::Window> window_of(const map::OpenedGrid& grid, const std::vector<double>& crop) {
  const terrain::GridFrame frame = grid.heights->frame();
  const terrain::Rectangle d = frame.domain();
  const std::string range = core::joined(
      {"west,south,east,north; the grid's heights lie within ", place(d.x_min, d.y_min, grid.is_in_degrees),
       ",", place(d.x_max, d.y_max, grid.is_in_degrees), grid.is_in_degrees ? " (degrees)" : " (metres)"});
  const double west = crop[0], south = crop[1], east = crop[2], north = crop[3];
  if (west >= east) return core::fail("--crop", "its west is not west of its east", range);
  if (south >= north) return core::fail("--crop", "its south is not south of its north", range);
  // A height stands in the middle of its cell, and the header's corner is that of a cell.
  const double x_rim = 0.501 * frame.dx, y_rim = 0.501 * frame.dy;
  if (west < d.x_min - x_rim || east > d.x_max + x_rim || south < d.y_min - y_rim || north > d.y_max + y_rim)
    return core::fail("--crop", "reaches past the grid", range);
  const Knots columns = knots_within(west, east, frame.x_origin, frame.dx, frame.columns);
  const Knots rows = knots_within(south, north, frame.y_origin, frame.dy, frame.rows);
  if (columns.count < map::kMinKnotsEachWay || rows.count < map::kMinKnotsEachWay) {
    return core::fail("--crop",
                      core::joined({"leaves ", std::to_string(columns.count), " by ",
                                    std::to_string(rows.count), " knots, 4 each way are wanted"}),
                      range);
  }
  if (columns.count > map::kMaxKnots / rows.count)
    return core::fail("--crop", "leaves more than " + std::to_string(map::kMaxKnots) + " knots", "crop more");
  return map::Window{columns.first, rows.first, columns.count, rows.count};
}

}  // namespace

core::Expected<elevation::Ground> cropped_ground(const std::filesystem::path& file,
                                                 const std::vector<double>& crop, double scale) {
  const map::DiskFolder folder(file.parent_path().empty() ? "." : file.parent_path());
  const auto opened = map::open_grid(folder, file.filename().string());
  if (!opened) return tl::unexpected(opened.error());
  const auto window = window_of(*opened, crop);
  if (!window) return tl::unexpected(window.error());
  auto grid = map::read_heights(*opened->heights, *window, file.string());
  if (!grid) return tl::unexpected(grid.error());
  if (map::is_float_grid(file.string())) {  // as of one that a map names
    for (double& height : grid->heights) {
      if (std::fabs(height * scale) > map::kHeight.max) height = std::numeric_limits<double>::quiet_NaN();
    }
  }
  // The mark may be met anywhere in the file.
  if (std::none_of(grid->heights.begin(), grid->heights.end(), [](double z) { return std::isnan(z); }))
    grid->undeclared_mark.reset();
  elevation::GroundOptions options;
  options.scale = scale;
  options.unit = opened->is_in_degrees ? elevation::LengthUnit::kDegrees : elevation::LengthUnit::kMetres;
  return elevation::make_ground(std::move(*grid), options, file.string());
}

}  // namespace woodlouse::server
