// Which part of the terminal shows what.
//
//     status line                      1 row
//     goal                 |           where a mode of play has lines
//     map                  | panel     the panel 24 columns wide below 80, 33 up to 159, 38 beyond
//     lesson               |           where there is one
//     rule (ASCII), scrubber (replay)  1 row
//     keys                             1 row
#pragma once

#include <cstdint>

#include "client/cells/cell_buffer.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// A rectangle of cells.
struct Viewport {
  int column = 0;
  int row = 0;
  Size size;

  /// Whether a cell counted from the rectangle's own corner lies in it.
  [[nodiscard]] constexpr bool holds(int x, int y) const {
    return x >= 0 && y >= 0 && x < size.columns && y < size.rows;
  }
  friend constexpr bool operator==(const Viewport&, const Viewport&) = default;
};

/// Whether the terrain is painted in half-block pixels: needs the characters and 256 colours.
constexpr bool paints_pixels(const Look& look) {
  return look.glyphs == GlyphSet::kHalfBlocks &&
         (look.color == ColorMode::k256 || look.color == ColorMode::kTruecolor);
}

/// Rows that lines take from the map, so that they hide nothing of it.
struct LineRows {
  int goal = 0;
  int lesson = 0;
};

struct Layout {
  Viewport goal;  ///< above the map
  Viewport map;
  Viewport lesson;  ///< below it
  Viewport panel;
  int rule_row = -1;  ///< of the rule or the scrubber; -1: neither
  int key_row = 0;
};

/// What stands below the map.
enum class Foot : std::uint8_t { kKeys, kScrubberAndKeys };

/// REQUIRES a size of kSmallestSize or more.
constexpr Layout layout_for(Size size, const Look& look, Foot foot = Foot::kKeys, LineRows lines = {}) {
  const int panel = size.columns < 80 ? 24 : size.columns < 160 ? 33 : 38;
  const int rule = paints_pixels(look) && foot == Foot::kKeys ? 0 : 1;
  const int rows = size.rows - 2 - rule;
  Layout layout;
  const int columns = size.columns - panel;
  const int map_rows = rows - lines.goal - lines.lesson;
  layout.goal = {0, 1, {columns, lines.goal}};
  layout.map = {0, 1 + lines.goal, {columns, map_rows}};
  layout.lesson = {0, 1 + lines.goal + map_rows, {columns, lines.lesson}};
  layout.panel = {size.columns - panel, 1, {panel, rows}};
  layout.rule_row = rule == 1 ? size.rows - 2 : -1;
  layout.key_row = size.rows - 1;
  return layout;
}

}  // namespace woodlouse::client
