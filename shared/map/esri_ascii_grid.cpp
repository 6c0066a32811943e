#include "shared/map/esri_ascii_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>

#include "shared/core/joined.h"
#include "shared/json/decimal_number.h"
#include "shared/json/text.h"
#include "shared/map/esri_header.h"
#include "shared/map/map_text.h"
#include "shared/map/terrain_ranges.h"

namespace woodlouse::map {
namespace {

struct Word {
  std::string_view text;
  std::size_t line = 0;
};

/// Cuts the text at white space; counts lines.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word without taking it; an empty one at the end.
  const Word& peek() {
    if (next_.text.empty()) advance();
    return next_;
  }
  Word take() {
    const Word word = peek();
    next_ = {};
    return word;
  }

 private:
  static bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\v';
  }

  void advance() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    next_ = {text_.substr(begin, at_ - begin), line_};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  Word next_;
};

/// The whole word as a number; infinities and NaN included.
std::optional<double> to_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = json::read_decimal(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// A word of the file within a message, cut to a readable length.
std::string quoted(std::string_view word) { return core::joined({"\"", json::shown(word, 32), "\""}); }

struct Entry {
  std::optional<double> value;
  std::size_t line = 0;
};

struct Header {
  Entry ncols, nrows, xllcorner, xllcenter, yllcorner, yllcenter, cellsize, dx, dy, nodata_value;

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
    if (entry == nullptr && problems.is_full()) {
      problems.leave_out(1);
      if (!begins_like_a_key(words.peek())) words.take();
      continue;
    }
    if (entry == nullptr) {
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
      problems.add(value.line, key, quoted(value.text) + " is no number");
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

void read_spacings(const Header& header, terrain::HeightGrid& grid, json::Problems& problems) {
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

void read_heights(Words& words, const Header& header, terrain::HeightGrid& grid, json::Problems& problems) {
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
    if (!height) {
      const bool has_comma = word.text.find(',') != std::string_view::npos;
      problems.add(word.line, cell_name(index, grid.columns), quoted(word.text) + " is no number",
                   has_comma ? "the decimal sign is a point" : "");
      continue;
    }
    const bool is_hole = header.nodata_value.value && *height == *header.nodata_value.value;
    if (is_hole || !std::isfinite(*height)) {
      problems.add(word.line, cell_name(index, grid.columns),
                   "no data: a hole in the ground can't be played on",
                   "fill it, for example with gdal_fillnodata.py, or cut it off with gdal_translate -srcwin");
      continue;
    }
    const std::size_t row_from_south = grid.rows - 1 - index / grid.columns;
    grid.heights[row_from_south * grid.columns + index % grid.columns] = *height;
  }
  if (!words.peek().text.empty()) {
    problems.add(words.peek().line, {},
                 core::joined({"more than ncols * nrows = ", std::to_string(total), " heights"}));
  }
}

}  // namespace

std::optional<terrain::HeightGrid> parse_esri_ascii_grid(std::string_view text, json::Problems& problems) {
  const std::size_t problems_before = problems.count();
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  Words words(text);
  const Header header = read_header(words, problems);

  terrain::HeightGrid grid;
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
  return grid;
}

}  // namespace woodlouse::map
