#include "shared/terrain/bspline_tile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <vector>

#include "shared/terrain/bspline_coefficients.h"
#include "shared/terrain/fill_missing.h"

namespace woodlouse::terrain {
namespace {

/// Knots first .. first + count - 1 along one axis.
struct Stretch {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The stretch grown by `margin` either way, within 0 .. knots - 1.
Stretch grown(Stretch s, std::size_t margin, std::size_t knots) {
  const std::size_t first = s.first > margin ? s.first - margin : 0;
  return {first, std::min(s.first + s.count + margin, knots) - first};
}

using Field = std::vector<double>;  // row by row

Field read_window(const HeightSource& source, Stretch columns, Stretch rows) {
  Field heights(columns.count * rows.count);
  for (std::size_t j = 0; j < rows.count; ++j) {
    source.read(columns.first, rows.first + j, std::span(heights).subspan(j * columns.count, columns.count));
  }
  return heights;
}

bool has_missing(const Field& heights) {
  return std::any_of(heights.begin(), heights.end(), [](double z) { return !std::isfinite(z); });
}

/// The window's heights, with filled holes: filled on a window grown by the reach of the filling, so that the
/// same knot gets the same height in every window.
Field filled_window(const HeightSource& source, const GridFrame& frame, Stretch columns, Stretch rows,
                    double level) {
  const Stretch wide = grown(columns, kFillReach, frame.columns);
  const Stretch high = grown(rows, kFillReach, frame.rows);
  Field large = read_window(source, wide, high);
  fill_missing(large, wide.count, level);
  Field heights;
  heights.reserve(columns.count * rows.count);
  for (std::size_t j = 0; j < rows.count; ++j) {
    const std::size_t begin = (rows.first - high.first + j) * wide.count + (columns.first - wide.first);
    heights.insert(heights.end(), large.begin() + static_cast<std::ptrdiff_t>(begin),
                   large.begin() + static_cast<std::ptrdiff_t>(begin + columns.count));
  }
  return heights;
}

Field transposed(const Field& field, std::size_t columns) {
  const std::size_t rows = field.size() / columns;
  Field result(field.size());
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) result[i * rows + j] = field[j * columns + i];
  }
  return result;
}

/// Coefficients along the slow index of `field`, `lanes` numbers each: those of the tile's knots and their
/// neighbours alone.
Field tile_coefficients(const Field& field, std::size_t lanes, Stretch window, Stretch tile) {
  Field all(field.size() + 2 * lanes);
  bspline_coefficients(field, lanes, all);
  const std::size_t begin =
      (tile.first - window.first) * lanes;  // c[tile.first - 1]: all begins at c[window.first - 1]
  const std::size_t count = (tile.count + 2) * lanes;
  return Field(all.begin() + static_cast<std::ptrdiff_t>(begin),
               all.begin() + static_cast<std::ptrdiff_t>(begin + count));
}

void mark_holes(const Field& raw, Stretch window_columns, Stretch window_rows, Stretch columns, Stretch rows,
                BSplineTile& tile) {
  const auto missing = [&](std::size_t i, std::size_t j) {
    return !std::isfinite(raw[(rows.first - window_rows.first + j) * window_columns.count + columns.first -
                              window_columns.first + i]);
  };
  auto holes = std::make_unique<std::bitset<BSplineTile::kCells * BSplineTile::kCells>>();
  for (std::size_t j = 0; j + 1 < rows.count; ++j) {
    for (std::size_t i = 0; i + 1 < columns.count; ++i) {
      (*holes)[j * BSplineTile::kCells + i] =
          missing(i, j) || missing(i + 1, j) || missing(i, j + 1) || missing(i + 1, j + 1);
    }
  }
  if (holes->any()) tile.holes = std::move(holes);
}

}  // namespace

std::unique_ptr<BSplineTile> build_tile(const HeightSource& source, std::size_t column, std::size_t row,
                                        double fill_level) {
  const GridFrame frame = source.frame();
  assert(frame.columns >= 4 && frame.rows >= 4 && column + 1 < frame.columns && row + 1 < frame.rows);
  const Stretch columns{column, std::min(BSplineTile::kCells + 1, frame.columns - column)};
  const Stretch rows{row, std::min(BSplineTile::kCells + 1, frame.rows - row)};
  const Stretch wide = grown(columns, BSplineTile::kMargin, frame.columns);
  const Stretch high = grown(rows, BSplineTile::kMargin, frame.rows);

  auto tile = std::make_unique<BSplineTile>();
  Field heights = read_window(source, wide, high);
  if (has_missing(heights)) {
    mark_holes(heights, wide, high, columns, rows, *tile);
    heights = filled_window(source, frame, wide, high, fill_level);
  }
  const Field along_x = tile_coefficients(transposed(heights, wide.count), high.count, wide, columns);
  const Field both = tile_coefficients(transposed(along_x, high.count), columns.count + 2, high, rows);
  tile->c.fill(0.0);
  for (std::size_t j = 0; j < rows.count + 2; ++j) {
    for (std::size_t i = 0; i < columns.count + 2; ++i) {
      tile->c[j * BSplineTile::kStride + i] = both[j * (columns.count + 2) + i] * (1.0 / 36.0);
    }
  }
  return tile;
}

}  // namespace woodlouse::terrain
