#include "client/cells/cell_buffer.h"

#include <algorithm>

#include "shared/core/utf8.h"

namespace woodlouse::client {
namespace {

bool is_one_column_wide(char32_t c, GlyphSet glyphs) {
  if (c >= 0x20 && c < 0x7F) return true;
  if (glyphs == GlyphSet::kAscii) return false;
  // Latin, Greek and Cyrillic letters: no soft hyphen (U+00AD), no unassigned, no combining (U+0483..U+0489).
  return (c >= 0xA1 && c <= 0x24F && c != 0xAD) ||
         (c >= 0x386 && c <= 0x3FF && c != 0x38B && c != 0x38D && c != 0x3A2) || (c >= 0x400 && c <= 0x482) ||
         (c >= 0x48A && c <= 0x4FF);
}

}  // namespace

std::u32string printable(std::string_view utf8, GlyphSet glyphs) {
  std::u32string result;
  while (!utf8.empty()) {
    const core::Utf8Character character = core::first_character(utf8);
    const bool is_shown = character.valid && is_one_column_wide(character.code, glyphs);
    result.push_back(is_shown ? character.code : U'?');
    utf8.remove_prefix(character.size);
  }
  return result;
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
