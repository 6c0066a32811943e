#include "shared/elevation/surfer_ascii.h"

#include <cmath>
#include <limits>

#include "shared/elevation/grid_words.h"

namespace woodlouse::elevation {
namespace {

constexpr std::string_view kMagic = "DSAA";
constexpr double kMostCoordinate = 1e9;

std::string at_line(const std::string& source, const Word& word) {
  return source + ":" + std::to_string(word.line);
}

core::Expected<double> number(Words& words, const std::string& source, std::string_view what) {
  const Word word = words.take();
  if (word.text.empty())
    return core::fail(at_line(source, word), "the file ends before " + std::string(what));
  const auto value = to_number(word.text);
  if (!value)
    return core::fail(at_line(source, word), std::string(what) + ": " + quoted(word.text) + " is no number",
                      number_hint(word.text));
  return *value;
}

struct Axis {
  double first = 0.0;
  double step = 0.0;
};

core::Expected<Axis> axis(Words& words, const std::string& source, std::string_view what, std::size_t knots) {
  const auto first = number(words, source, what);
  if (!first) return tl::unexpected(first.error());
  const Word place = words.peek();
  const auto last = number(words, source, what);
  if (!last) return tl::unexpected(last.error());
  const double step = (*last - *first) / static_cast<double>(knots - 1);
  if (std::fabs(*first) <= kMostCoordinate && std::fabs(*last) <= kMostCoordinate && step > 0.0)
    return Axis{*first, step};
  return core::fail(at_line(source, place),
                    std::string(what) + ": are not the first and the last, within 1e9");
}

core::Expected<std::size_t> count(Words& words, const std::string& source, std::string_view what,
                                  std::size_t most) {
  const Word place = words.peek();
  const auto value = number(words, source, what);
  if (!value) return tl::unexpected(value.error());
  if (*value >= 4.0 && *value <= static_cast<double>(most) && std::floor(*value) == *value)
    return static_cast<std::size_t>(*value);
  return core::fail(at_line(source, place),
                    std::string(what) + ": is no whole number of 4 to " + std::to_string(most));
}

}  // namespace

bool is_surfer_ascii(std::string_view text) { return text.substr(0, kMagic.size()) == kMagic; }

core::Expected<FileGrid> parse_surfer_ascii(std::string_view text, const std::string& source,
                                            std::size_t most_knots) {
  Words words(text);
  if (words.take().text != kMagic) return core::fail(source, "does not begin with DSAA");
  const auto columns = count(words, source, "columns", most_knots);
  if (!columns) return tl::unexpected(columns.error());
  const auto rows = count(words, source, "rows", most_knots);
  if (!rows) return tl::unexpected(rows.error());
  if (*rows > most_knots / *columns)
    return core::fail(source, "has more than " + std::to_string(most_knots) + " heights",
                      "thin it out, for example with gdal_translate -outsize 25% 25%");
  const auto x = axis(words, source, "the range of x", *columns);
  if (!x) return tl::unexpected(x.error());
  const auto y = axis(words, source, "the range of y", *rows);
  if (!y) return tl::unexpected(y.error());
  for (int k = 0; k < 2; ++k) {
    if (const auto z = number(words, source, "the range of z"); !z) return tl::unexpected(z.error());
  }
  FileGrid grid;
  grid.columns = *columns;
  grid.rows = *rows;
  grid.x_origin = x->first;
  grid.y_origin = y->first;
  grid.dx = x->step;
  grid.dy = y->step;
  // Not before they are there: a short text must not ask for millions of heights.
  for (std::size_t k = 0; k < *columns * *rows; ++k) {
    const auto height = number(words, source, "a height");
    if (!height) return tl::unexpected(height.error());
    grid.heights.push_back(std::fabs(*height) < kNoHeightFrom ? *height
                                                              : std::numeric_limits<double>::quiet_NaN());
  }
  if (!words.peek().text.empty()) {
    return core::fail(at_line(source, words.peek()),
                      "more than columns * rows = " + std::to_string(*columns * *rows) + " heights");
  }
  take_undeclared_mark(grid);
  return grid;
}

}  // namespace woodlouse::elevation
