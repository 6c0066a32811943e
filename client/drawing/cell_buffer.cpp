#include "client/drawing/cell_buffer.h"

#include <algorithm>

namespace woodlouse::client {
namespace {

/// A code point of `utf8` at `at`, which is moved past it; U+FFFD for a byte that begins none.
char32_t take_code_point(std::string_view utf8, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(utf8[i]); };
  const unsigned lead = byte(at++);
  if (lead < 0x80) return lead;
  std::size_t more = 0;
  char32_t smallest = 0;
  char32_t value = 0;
  if ((lead & 0xE0u) == 0xC0u) more = 1, smallest = 0x80, value = lead & 0x1Fu;
  if ((lead & 0xF0u) == 0xE0u) more = 2, smallest = 0x800, value = lead & 0x0Fu;
  if ((lead & 0xF8u) == 0xF0u) more = 3, smallest = 0x10000, value = lead & 0x07u;
  if (more == 0 || at + more > utf8.size()) return U'\uFFFD';
  for (std::size_t i = 0; i < more; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return U'\uFFFD';
    value = (value << 6) | (byte(at + i) & 0x3Fu);
  }
  if (value < smallest) return U'\uFFFD';
  at += more;
  return value;
}

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
  for (std::size_t at = 0; at < utf8.size();) {
    const char32_t c = take_code_point(utf8, at);
    result.push_back(is_one_column_wide(c, glyphs) ? c : U'?');
  }
  return result;
}

void append_utf8(char32_t c, std::string& out) {
  const auto byte = [&](char32_t value) {
    out.push_back(static_cast<char>(static_cast<unsigned char>(value)));
  };
  if (c < 0x80) return byte(c);
  if (c < 0x800) return byte(0xC0 | (c >> 6)), byte(0x80 | (c & 0x3F));
  if (c < 0x10000) return byte(0xE0 | (c >> 12)), byte(0x80 | ((c >> 6) & 0x3F)), byte(0x80 | (c & 0x3F));
  byte(0xF0 | (c >> 18)), byte(0x80 | ((c >> 12) & 0x3F)), byte(0x80 | ((c >> 6) & 0x3F)),
      byte(0x80 | (c & 0x3F));
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
