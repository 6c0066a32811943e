// A grid of terminal cells: what a frame looks like before anyone knows how to write it.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "client/cells/color.h"

namespace woodlouse::client {

/// Columns and rows of cells.
struct Size {
  int columns = 0;
  int rows = 0;
  friend constexpr bool operator==(Size, Size) = default;
};

/// Attributes are bits: kBold | kReverse.
using Attributes = std::uint8_t;
inline constexpr Attributes kPlain = 0;
inline constexpr Attributes kBold = 1;
inline constexpr Attributes kReverse = 2;

/// How a text is drawn.
struct Style {
  Color foreground;
  Color background;
  Attributes attributes = kPlain;
  friend constexpr bool operator==(const Style&, const Style&) = default;
};

/// One character cell. `glyph` is a printable code point one column wide, or two: then kWideTail
/// (character_width.h) stands in the cell to its right.
struct Cell {
  char32_t glyph = U' ';
  Style style;
  friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

/// Which characters may be drawn.
enum class GlyphSet : std::uint8_t {
  kAscii,       ///< U+0020..U+007E only
  kHalfBlocks,  ///< U+2580 and all that columns_of() has columns for
};

/// The printable code points of a UTF-8 text, one element a column: kWideTail follows a character two columns
/// wide. Marks are composed with their letter or left out; everything else (control characters, bad bytes)
/// becomes '?', so that columns stay aligned and nothing a stranger typed reaches the terminal as a command.
/// For kAscii Latin letters lose their marks, and what is no ASCII becomes one '?' a character.
std::u32string printable(std::string_view utf8, GlyphSet glyphs);

/// The cell as it can be shown: half of a wide character, whose other half something was written over or
/// which stands at an edge, is a blank. REQUIRES column < row.size().
Cell whole_cell(std::span<const Cell> row, std::size_t column);

class CellBuffer {
 public:
  CellBuffer() = default;
  explicit CellBuffer(Size size) { resize(size); }

  /// Sets the size; every cell becomes blank. Sizes below zero count as zero.
  void resize(Size size);
  /// Every cell becomes a space of this style.
  void clear(const Style& style = {});

  [[nodiscard]] Size size() const { return size_; }
  [[nodiscard]] bool contains(int column, int row) const {
    return column >= 0 && row >= 0 && column < size_.columns && row < size_.rows;
  }
  /// REQUIRES contains(column, row).
  [[nodiscard]] const Cell& at(int column, int row) const { return cells_[index(column, row)]; }
  [[nodiscard]] Cell& at(int column, int row) { return cells_[index(column, row)]; }
  [[nodiscard]] std::span<const Cell> row(int row) const {
    return std::span<const Cell>(cells_).subspan(index(0, row), static_cast<std::size_t>(size_.columns));
  }

  /// Sets a cell; outside the grid nothing happens.
  void put(int column, int row, char32_t glyph, const Style& style);
  /// Writes code points from (column, row) to the right, at most `width` of them, clipped to the grid.
  /// Returns the column after the last one.
  int text(int column, int row, std::u32string_view code_points, const Style& style, int width = 1 << 20);
  /// The same for ASCII text; other bytes become '?'.
  int text(int column, int row, std::string_view ascii, const Style& style, int width = 1 << 20);
  /// Makes a rectangle blank, clipped to the grid.
  void fill(int column, int row, Size size, const Style& style);

  friend bool operator==(const CellBuffer&, const CellBuffer&) = default;

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    assert(contains(column, row));
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.columns) +
           static_cast<std::size_t>(column);
  }

  Size size_;
  std::vector<Cell> cells_;
};

}  // namespace woodlouse::client
