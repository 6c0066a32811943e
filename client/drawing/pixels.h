// Two square pixels a cell: the upper one is the colour of a half-block character, the lower one its
// background.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"
#include "client/drawing/layout.h"

namespace woodlouse::client {

inline constexpr char32_t kUpperHalfBlock = U'\u2580';

/// The cells of size.columns x 2 size.rows pixels, given row by row.
inline std::vector<Cell> cells_of_pixels(std::span<const Color> pixels, Size size) {
  const auto width = static_cast<std::size_t>(size.columns);
  std::vector<Cell> cells;
  cells.reserve(pixels.size() / 2);
  for (std::size_t row = 0; row < static_cast<std::size_t>(size.rows); ++row)
    for (std::size_t x = 0; x < width; ++x)
      cells.push_back(
          {kUpperHalfBlock, {pixels[2 * row * width + x], pixels[(2 * row + 1) * width + x], kPlain}});
  return cells;
}

/// Paints a pixel of the viewport; outside it, and in a cell that shows a character, nothing happens.
inline void put_pixel(CellBuffer& cells, const Viewport& viewport, int x, int y, Color color) {
  if (y < 0 || !viewport.holds(x, y / 2) || !cells.contains(viewport.column + x, viewport.row + y / 2))
    return;
  Cell& cell = cells.at(viewport.column + x, viewport.row + y / 2);
  if (cell.glyph != kUpperHalfBlock) return;
  (y % 2 == 0 ? cell.style.foreground : cell.style.background) = color;
}

/// How a colour looks; an entry of the palette as xterm has it.
inline Rgb rgb_of(Color color) {
  return color.kind == Color::Kind::kRgb ? color.rgb : palette_color(color.index());
}

/// The background for a character over what a cell shows: its pixels mixed and darkened, so that the
/// character stands out from its own louse's trail.
inline Color ground_of(const Cell& cell) {
  return Color::of(scaled(mix(rgb_of(cell.style.foreground), rgb_of(cell.style.background), 0.5), 0.5));
}

/// Writes a character over the picture. In a cell that shows a character already nothing happens.
inline void put_over(CellBuffer& cells, const Viewport& viewport, int column, int row, char32_t glyph,
                     Color color, Attributes attributes = kBold) {
  if (!viewport.holds(column, row) || !cells.contains(viewport.column + column, viewport.row + row)) return;
  Cell& cell = cells.at(viewport.column + column, viewport.row + row);
  if (cell.glyph == kUpperHalfBlock) cell = {glyph, {color, ground_of(cell), attributes}};
}

/// Calls paint(x, y, t) for the pixels of a line, t from 0 at its beginning to 1 at its end.
template <typename Paint>
void for_line(double x0, double y0, double x1, double y1, const Paint& paint) {
  const double longest = std::max(std::abs(x1 - x0), std::abs(y1 - y0));
  if (!(longest < 4096.0)) return;
  const int steps = std::max(1, static_cast<int>(std::ceil(longest)));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    paint(static_cast<int>(std::floor(x0 + (x1 - x0) * t)), static_cast<int>(std::floor(y0 + (y1 - y0) * t)),
          t);
  }
}

}  // namespace woodlouse::client
