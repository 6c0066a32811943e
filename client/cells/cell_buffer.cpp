#include "client/cells/cell_buffer.h"

#include <algorithm>

#include "client/cells/character_width.h"
#include "shared/core/utf8.h"

namespace woodlouse::client {
std::u32string printable(std::string_view utf8, GlyphSet glyphs) {
  std::u32string result;
  std::size_t last = 0;  // where the last character begins
  for (; !utf8.empty();) {
    const core::Utf8Character character = core::first_character(utf8);
    utf8.remove_prefix(character.size);
    const int columns = character.valid ? columns_of(character.code) : -1;
    if (columns == 0) {
      const char32_t whole = last < result.size() ? composed(result[last], character.code) : 0;
      if (whole != 0) result[last] = whole;
      continue;
    }
    last = result.size();
    result.push_back(columns > 0 ? character.code : U'?');
    if (columns == 2) result.push_back(kWideTail);
  }
  if (glyphs == GlyphSet::kHalfBlocks) return result;
  std::erase(result, kWideTail);
  for (char32_t& c : result) c = static_cast<char32_t>(ascii_of(c));
  return result;
}

Cell whole_cell(std::span<const Cell> row, std::size_t column) {
  Cell cell = row[column];
  const bool is_tail = cell.glyph == kWideTail;
  // Asked of every cell of every frame: letters of Europe, lines and blocks need no table.
  const bool is_narrow = cell.glyph < 0x1100 || (cell.glyph >= 0x2500 && cell.glyph < 0x25A0);
  if (!is_tail && (is_narrow || columns_of(cell.glyph) != 2)) return cell;
  const bool is_whole = is_tail ? column > 0 && columns_of(row[column - 1].glyph) == 2
                                : column + 1 < row.size() && row[column + 1].glyph == kWideTail;
  if (!is_whole) cell.glyph = U' ';
  if (is_tail && is_whole) cell.style = row[column - 1].style;
  return cell;
}

void CellBuffer::resize(Size size) {
  size_ = {std::max(0, size.columns), std::max(0, size.rows)};
  cells_.assign(static_cast<std::size_t>(size_.columns) * static_cast<std::size_t>(size_.rows), Cell());
}

void CellBuffer::clear(const Style& style) { std::fill(cells_.begin(), cells_.end(), Cell{U' ', style}); }

void CellBuffer::put(int column, int row, char32_t glyph, const Style& style) {
  if (contains(column, row)) cells_[index(column, row)] = {glyph, style};
}

int CellBuffer::text(int column, int row, std::u32string_view code_points, const Style& style, int width) {
  for (const char32_t c : code_points) {
    if (width-- <= 0) break;
    put(column++, row, c, style);
  }
  return column;
}

int CellBuffer::text(int column, int row, std::string_view ascii, const Style& style, int width) {
  return text(column, row, printable(ascii, GlyphSet::kAscii), style, width);
}

void CellBuffer::fill(int column, int row, Size size, const Style& style) {
  for (int y = row; y < row + size.rows; ++y)
    for (int x = column; x < column + size.columns; ++x) put(x, y, U' ', style);
}

}  // namespace woodlouse::client
