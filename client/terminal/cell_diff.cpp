#include "client/terminal/cell_diff.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "client/cells/character_width.h"
#include "shared/core/utf8.h"

namespace woodlouse::client {
namespace {

constexpr char32_t kUpperHalf = U'\u2580';
constexpr char32_t kLowerHalf = U'\u2584';

void append_number(int value, std::string& out) {
  char digits[12];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  out.append(digits, end);
}

/// A blank shows its background only, unless it is in reverse video.
bool shows_only_background(const Cell& cell) {
  return cell.glyph == U' ' && (cell.style.attributes & kReverse) == 0;
}

/// The same look in one spelling, so that equal looks compare equal.
Cell canonical(Cell cell, ColorMode mode) {
  cell.style.foreground = quantise(cell.style.foreground, mode);
  cell.style.background = quantise(cell.style.background, mode);
  const bool plain = (cell.style.attributes & kReverse) == 0;
  if (cell.glyph == kLowerHalf && plain) {
    cell.glyph = kUpperHalf;
    std::swap(cell.style.foreground, cell.style.background);
  }
  if (cell.glyph == kUpperHalf && plain && cell.style.foreground == cell.style.background) cell.glyph = U' ';
  if (shows_only_background(cell)) {
    cell.style.foreground = {};
    cell.style.attributes = kPlain;
  }
  return cell;
}

void append_color(Color color, bool background, std::string& out) {
  const int base = background ? 40 : 30;
  switch (color.kind) {
    case Color::Kind::kDefault:
      append_number(base + 9, out);
      return;
    case Color::Kind::kIndexed:
      if (color.index() < 16) {
        append_number(color.index() < 8 ? base + color.index() : base + 60 + color.index() - 8, out);
        return;
      }
      append_number(base + 8, out);
      out += ";5;";
      append_number(color.index(), out);
      return;
    case Color::Kind::kRgb:
      append_number(base + 8, out);
      out += ";2;";
      append_number(color.rgb.r, out);
      out += ';';
      append_number(color.rgb.g, out);
      out += ';';
      append_number(color.rgb.b, out);
      return;
  }
}

}  // namespace

std::string FrameEncoder::encode(const CellBuffer& frame) {
  std::string out;
  const Size size = frame.size();
  if (!known_ || shown_.size() != size) {
    out += "\x1b[0m\x1b[2J\x1b[H";
    shown_.resize(size);
    next_.resize(size);
    given_.resize({});  // no row is as it was given
    style_ = {};
    cursor_column_ = 0;
    cursor_row_ = 0;
    known_ = true;
  }
  for (int row = 0; row < size.rows; ++row) {
    const auto cells = frame.row(row);
    if (given_.size() == size && std::ranges::equal(cells, given_.row(row))) continue;
    for (int column = 0; column < size.columns; ++column)
      next_.at(column, row) = canonical(whole_cell(cells, static_cast<std::size_t>(column)), mode_);
    encode_row(row, out);
    for (int column = 0; column < size.columns; ++column) shown_.at(column, row) = next_.at(column, row);
  }
  given_ = frame;
  return out;
}

void FrameEncoder::encode_row(int row, std::string& out) {
  const int columns = next_.size().columns;
  for (int column = 0; column < columns; ++column) {
    const Cell& cell = next_.at(column, row);
    if (cell == shown_.at(column, row) || cell.glyph == kWideTail) continue;
    move_to(column, row, out);
    Style style = cell.style;
    char32_t glyph = cell.glyph;
    if (shows_only_background(cell)) {
      style.foreground = style_.foreground;
      style.attributes = style_.attributes & kBold;
    } else if (glyph == kUpperHalf && style.attributes == kPlain &&
               (style.foreground == style_.background || style.background == style_.foreground)) {
      glyph = kLowerHalf;
      std::swap(style.foreground, style.background);
    }
    set_style(style, out);
    core::append_character(out, glyph);
    // After the last column terminals differ in where the cursor is; no cell has that place.
    cursor_column_ = column + 1;
    // Whether the terminal takes it for as wide as we do nobody knows: the next cell is named.
    if (column + 1 < columns && next_.at(column + 1, row).glyph == kWideTail) cursor_row_ = -1;
  }
}

void FrameEncoder::move_to(int column, int row, std::string& out) {
  if (cursor_row_ == row && cursor_column_ == column) return;
  const int gap = column - cursor_column_;
  if (cursor_row_ == row && gap > 0) {
    bool reprint = gap <= 3;
    for (int i = cursor_column_; reprint && i < column; ++i) {
      const Cell& cell = next_.at(i, row);
      reprint = cell.glyph > U' ' && cell.glyph < 0x7F && cell.style == style_;
    }
    if (reprint) {
      for (int i = cursor_column_; i < column; ++i) core::append_character(out, next_.at(i, row).glyph);
    } else {
      out += "\x1b[";
      if (gap > 1) append_number(gap, out);
      out += 'C';
    }
  } else {
    out += "\x1b[";
    append_number(row + 1, out);
    if (column > 0) {
      out += ';';
      append_number(column + 1, out);
    }
    out += 'H';
  }
  cursor_row_ = row;
  cursor_column_ = column;
}

void FrameEncoder::set_style(const Style& style, std::string& out) {
  if (style == style_) return;
  out += "\x1b[";
  bool first = true;
  const auto separate = [&] {
    if (!first) out += ';';
    first = false;
  };
  const auto attribute = [&](Attributes bit, int on, int off) {
    if ((style.attributes & bit) == (style_.attributes & bit)) return;
    separate();
    append_number((style.attributes & bit) != 0 ? on : off, out);
  };
  attribute(kBold, 1, 22);
  attribute(kReverse, 7, 27);
  if (style.foreground != style_.foreground) separate(), append_color(style.foreground, false, out);
  if (style.background != style_.background) separate(), append_color(style.background, true, out);
  out += 'm';
  style_ = style;
}

}  // namespace woodlouse::client
