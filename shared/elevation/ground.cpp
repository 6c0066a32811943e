#include "shared/elevation/ground.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "shared/json/text.h"
#include "shared/terrain/fill_missing.h"
#include "shared/terrain/harmonic_fill.h"

namespace woodlouse::elevation {
namespace {

using terrain::GridFrame;
using terrain::HeightGrid;

constexpr std::size_t kLeastKnots = 4;

bool has_datum(const HeightGrid& grid, std::size_t first, std::size_t stride, std::size_t count) {
  for (std::size_t n = 0; n < count; ++n) {
    if (std::isfinite(grid.heights[first + n * stride])) return true;
  }
  return false;
}

/// Rows or columns without data, by side.
struct Margins {
  std::size_t west = 0, east = 0, south = 0, north = 0;

  [[nodiscard]] bool any() const { return west + east + south + north != 0; }
};

/// REQUIRES a datum somewhere.
Margins empty_margins(const HeightGrid& grid) {
  const auto column = [&](std::size_t i) { return has_datum(grid, i, grid.columns, grid.rows); };
  const auto row = [&](std::size_t j) { return has_datum(grid, j * grid.columns, 1, grid.columns); };
  Margins m;
  while (!column(m.west)) ++m.west;
  while (!column(grid.columns - 1 - m.east)) ++m.east;
  while (!row(m.south)) ++m.south;
  while (!row(grid.rows - 1 - m.north)) ++m.north;
  return m;
}

void cut(HeightGrid& grid, const Margins& m) {
  const std::size_t columns = grid.columns - m.west - m.east;
  const std::size_t rows = grid.rows - m.south - m.north;
  for (std::size_t j = 0; j < rows; ++j) {  // to the front: never onto what is still to be read
    const auto from =
        grid.heights.begin() + static_cast<std::ptrdiff_t>((j + m.south) * grid.columns + m.west);
    std::copy(from, from + static_cast<std::ptrdiff_t>(columns),
              grid.heights.begin() + static_cast<std::ptrdiff_t>(j * columns));
  }
  grid.columns = columns;
  grid.rows = rows;
  grid.heights.resize(columns * rows);
}

std::string cut_note(const Margins& m) {
  std::string text;
  const auto add = [&text](std::size_t count, const char* line, const char* side) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + line + (count == 1 ? "" : "s") +
            " in the " + side;
  };
  add(m.north, "row", "north");
  add(m.south, "row", "south");
  add(m.west, "column", "west");
  add(m.east, "column", "east");
  return "a rim without data was cut off: " + text;
}

/// `value` with so many digits behind the point.
std::string rounded(double value, double digits_factor) {
  std::string text;
  json::append_double(text, std::round(value * digits_factor) / digits_factor);
  return text;
}

void add_line(std::string& note, const std::string& line) { note += (note.empty() ? "" : ", ") + line; }

GridFrame frame_of(const HeightGrid& grid) {
  return {grid.columns, grid.rows, grid.x_origin, grid.y_origin, grid.dx, grid.dy};
}

}  // namespace

void take_undeclared_mark(FileGrid& grid) {
  for (const double mark : kCustomaryMarks) {
    if (std::find(grid.heights.begin(), grid.heights.end(), mark) == grid.heights.end()) continue;
    std::replace(grid.heights.begin(), grid.heights.end(), mark, std::numeric_limits<double>::quiet_NaN());
    grid.undeclared_mark = mark;
    return;
  }
}

std::string mark_note(double mark) {
  return rounded(mark, 1.0) + " was taken for no data, which the file does not say";
}

std::string degrees_note(const GridFrame& frame) {
  const GridFrame metres = in_metres(frame);
  return "degrees at latitude " + rounded(middle_latitude(frame), 100.0) + ": a cell is " +
         rounded(metres.dx, 1000.0) + " m by " + rounded(metres.dy, 1000.0) + " m";
}

double steepest_step(const HeightGrid& grid) {
  double steepest = 0.0;  // a NaN is never above it
  for (std::size_t k = 0; k < grid.heights.size(); ++k) {
    const double z = grid.heights[k];
    const double east =
        k % grid.columns + 1 < grid.columns ? std::fabs(grid.heights[k + 1] - z) / grid.dx : 0.0;
    const double north = k + grid.columns < grid.heights.size()
                             ? std::fabs(grid.heights[k + grid.columns] - z) / grid.dy
                             : 0.0;
    if (east > steepest) steepest = east;
    if (north > steepest) steepest = north;
  }
  return steepest;
}

core::Expected<Ground> make_ground(FileGrid file, const GroundOptions& options, const std::string& source) {
  assert(file.heights.size() == file.columns * file.rows && options.scale > 0.0);
  Ground ground;
  HeightGrid& grid = ground.grid;
  const std::optional<double> mark = file.undeclared_mark;
  grid = std::move(static_cast<HeightGrid&>(file));
  if (std::none_of(grid.heights.begin(), grid.heights.end(), [](double z) { return std::isfinite(z); })) {
    return core::fail(source, "has no heights, only knots without data",
                      "check NODATA_value and byteorder in its header");
  }
  const bool by_looks = options.unit == LengthUnit::kByLooks;
  if (options.unit == LengthUnit::kDegrees ||
      (by_looks && looks_like_degrees(frame_of(grid), steepest_step(grid)))) {
    add_line(ground.note, degrees_note(frame_of(grid)));
    const GridFrame metres = in_metres(frame_of(grid));
    grid.dx = metres.dx;
    grid.dy = metres.dy;
  }
  if (const Margins margins = empty_margins(grid); options.rim == Rim::kCut && margins.any()) {
    cut(grid, margins);
    add_line(ground.note, cut_note(margins));
    if (grid.columns < kLeastKnots || grid.rows < kLeastKnots) {
      return core::fail(source, "has data in less than 4 rows or columns",
                        "check NODATA_value in its header");
    }
  }
  grid.dx *= options.scale;
  grid.dy *= options.scale;
  grid.x_origin = -0.5 * (static_cast<double>(grid.columns - 1) * grid.dx);
  grid.y_origin = -0.5 * (static_cast<double>(grid.rows - 1) * grid.dy);
  std::size_t holes = 0;
  for (double& height : grid.heights) {
    height *= options.scale;
    if (!std::isfinite(height)) ++holes;
  }
  if (holes != 0) {
    if (options.fill_level) {
      terrain::fill_missing(grid.heights, grid.columns, *options.fill_level);
    } else {
      terrain::fill_harmonically(grid.heights, grid.columns, grid.dx, grid.dy);
    }
    add_line(ground.note, std::to_string(holes) + " of " + std::to_string(grid.heights.size()) +
                              " heights were filled from their shores");
  }
  if (mark) add_line(ground.note, mark_note(*mark));
  return ground;
}

}  // namespace woodlouse::elevation
