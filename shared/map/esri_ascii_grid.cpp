#include "shared/map/esri_ascii_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "shared/core/joined.h"
#include "shared/elevation/grid_words.h"
#include "shared/json/text.h"
#include "shared/map/esri_header.h"
#include "shared/map/map_text.h"
#include "shared/map/terrain_ranges.h"

namespace woodlouse::map {
namespace {

using elevation::FileGrid;
using elevation::quoted;
using elevation::to_number;
using elevation::Word;
using elevation::Words;

struct Entry {
  std::optional<double> value;
  std::size_t line = 0;
};

struct Header {
  Entry ncols, nrows, xllcorner, xllcenter, yllcorner, yllcenter, cellsize, dx, dy, nodata_value;
  bool has_unknown_key = false;

  [[nodiscard]] bool is_empty() const {
    for (const Entry* entry : {&ncols, &nrows, &xllcorner, &xllcenter, &yllcorner, &yllcenter, &cellsize, &dx,
                               &dy, &nodata_value}) {
      if (entry->line != 0) return false;
    }
    return true;
  }
  Entry* find(std::string_view key) {
    if (key == "ncols") return &ncols;
    if (key == "nrows") return &nrows;
    if (key == "xllcorner") return &xllcorner;
    if (key == "xllcenter") return &xllcenter;
    if (key == "yllcorner") return &yllcorner;
    if (key == "yllcenter") return &yllcenter;
    if (key == "cellsize") return &cellsize;
    if (key == "dx") return &dx;
    if (key == "dy") return &dy;
    if (key == "nodata_value") return &nodata_value;
    return nullptr;
  }
};

bool begins_like_a_key(const Word& word) {
  const std::string key = lower_case(word.text.substr(0, 3));
  return !key.empty() && key[0] >= 'a' && key[0] <= 'z' && key != "nan" && key != "inf";
}

Header read_header(Words& words, json::Problems& problems) {
  Header header;
  while (begins_like_a_key(words.peek())) {
    const Word word = words.take();
    const std::string key = lower_case(word.text.substr(0, 32));
    Entry* entry = header.find(key);
    if (entry == nullptr && header.has_unknown_key) {  // one is a slip, more are no header
      if (!begins_like_a_key(words.peek())) words.take();
      continue;
    }
    if (entry == nullptr) {
      header.has_unknown_key = true;
      problems.add(word.line, quoted(word.text), "is no header key",
                   json::did_you_mean(key, {"ncols", "nrows", "xllcorner", "xllcenter", "yllcorner",
                                            "yllcenter", "cellsize", "dx", "dy", "nodata_value"}));
      if (!begins_like_a_key(words.peek())) words.take();
      continue;
    }
    if (entry->line != 0) problems.add(word.line, key, "stands twice", "keep one of them");
    entry->line = word.line;
    if (words.peek().text.empty() || words.peek().line != word.line) {
      problems.add(word.line, key, "has no value");
      continue;
    }
    const Word value = words.take();
    entry->value = to_number(value.text);
    const bool may_be_anything = key == "nodata_value";  // GDAL writes nan here
    if (!entry->value || (!may_be_anything && !std::isfinite(*entry->value))) {
      problems.add(value.line, key, quoted(value.text) + " is no number", elevation::number_hint(value.text));
    }
  }
  return header;
}

std::size_t count_of(const Entry& entry, std::string_view key, json::Problems& problems) {
  if (entry.line == 0) problems.add(0, key, "is missing from the header");
  if (!entry.value) return 0;
  const double value = *entry.value;
  if (value >= static_cast<double>(kMinKnotsEachWay) && value <= static_cast<double>(kMaxKnots) &&
      std::floor(value) == value) {
    return static_cast<std::size_t>(value);
  }
  problems.add(entry.line, key, core::joined({"is no whole number of 4 to ", std::to_string(kMaxKnots)}));
  return 0;
}

double checked_spacing(const Entry& entry, std::string_view key, json::Problems& problems) {
  if (!entry.value) return 1.0;
  if (*entry.value > 0.0 && *entry.value <= kMaxHeaderCoordinate) return *entry.value;
  problems.add(entry.line, key, "is not above 0, or too large");
  return 1.0;
}

void read_spacings(const Header& header, FileGrid& grid, json::Problems& problems) {
  if (header.cellsize.line != 0) {
    grid.dx = grid.dy = checked_spacing(header.cellsize, "cellsize", problems);
  } else if (header.dx.line == 0 || header.dy.line == 0) {
    problems.add(0, "cellsize", "is missing from the header", "or both dx and dy");
  }
  if (header.dx.line != 0) grid.dx = checked_spacing(header.dx, "dx", problems);
  if (header.dy.line != 0) grid.dy = checked_spacing(header.dy, "dy", problems);
}

/// The first knot's coordinate: the centre of the south-western cell.
double origin_of(const Entry& corner, const Entry& center, std::string_view axis, double spacing,
                 json::Problems& problems) {
  const std::string either = core::joined({axis, "llcorner or ", axis, "llcenter"});
  if (corner.line == 0 && center.line == 0) problems.add(0, either, "is missing from the header");
  if (corner.line != 0 && center.line != 0) {
    problems.add(std::max(corner.line, center.line), either, "both are given", "keep one of them");
  }
  const double origin =
      center.line != 0 ? center.value.value_or(0.0) : corner.value.value_or(0.0) + 0.5 * spacing;
  if (std::abs(origin) <= kMaxHeaderCoordinate) return origin;
  problems.add(std::max(corner.line, center.line), either, "is out of range", "-1e9 to 1e9");
  return 0.0;
}

std::string cell_name(std::size_t index, std::size_t columns) {
  return core::joined(
      {"row ", std::to_string(index / columns + 1), ", column ", std::to_string(index % columns + 1)});
}

void read_heights(Words& words, const Header& header, FileGrid& grid, json::Problems& problems) {
  const std::size_t total = grid.columns * grid.rows;
  grid.heights.resize(total);
  for (std::size_t index = 0; index < total; ++index) {
    const Word word = words.take();
    if (word.text.empty()) {
      problems.add(word.line, cell_name(index, grid.columns),
                   core::joined({"the file ends here: ", std::to_string(index), " of ", std::to_string(total),
                                 " heights"}),
                   "compare ncols and nrows with the rows below them");
      return;
    }
    const std::optional<double> height = to_number(word.text);
    if (!height) {  // the first alone: a file of garbage has as many as cells
      problems.add(word.line, cell_name(index, grid.columns), quoted(word.text) + " is no number",
                   elevation::number_hint(word.text));
      return;
    }
    const bool is_hole = (header.nodata_value.value && *height == *header.nodata_value.value) ||
                         !(std::fabs(*height) < elevation::kNoHeightFrom);
    const std::size_t row_from_south = grid.rows - 1 - index / grid.columns;
    grid.heights[row_from_south * grid.columns + index % grid.columns] =
        is_hole ? std::numeric_limits<double>::quiet_NaN() : *height;
  }
  if (!words.peek().text.empty()) {
    problems.add(words.peek().line, {},
                 core::joined({"more than ncols * nrows = ", std::to_string(total), " heights"}));
  }
}

}  // namespace

std::optional<FileGrid> parse_esri_ascii_grid(std::string_view text, json::Problems& problems) {
  const std::size_t problems_before = problems.count();
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  Words words(text);
  json::Problems header_problems(problems.source());
  const Header header = read_header(words, header_problems);
  if (header.is_empty()) {
    problems.add(1, {}, "is no grid of text: its header has ncols, nrows, xllcorner, yllcorner and cellsize",
                 "gdal_translate -of AAIGrid writes one of most files");
    return std::nullopt;
  }
  problems.take_over(std::move(header_problems));

  FileGrid grid;
  grid.columns = count_of(header.ncols, "ncols", problems);
  grid.rows = count_of(header.nrows, "nrows", problems);
  read_spacings(header, grid, problems);
  grid.x_origin = origin_of(header.xllcorner, header.xllcenter, "x", grid.dx, problems);
  grid.y_origin = origin_of(header.yllcorner, header.yllcenter, "y", grid.dy, problems);
  if (grid.columns != 0 && grid.rows > kMaxKnots / grid.columns) {
    problems.add(header.nrows.line, "nrows",
                 core::joined({"more than ", std::to_string(kMaxKnots), " heights in all"}),
                 "thin it out, for example with gdal_translate -outsize 25% 25%");
  }
  if (problems.count() != problems_before || problems.is_full()) return std::nullopt;
  read_heights(words, header, grid, problems);
  if (problems.count() != problems_before) return std::nullopt;
  if (header.nodata_value.line == 0) elevation::take_undeclared_mark(grid);
  return grid;
}

}  // namespace woodlouse::map
