#include "client/drawing/frame_box.h"

#include <algorithm>

#include "shared/core/joined.h"

namespace woodlouse::client {
namespace {

constexpr char32_t kThinRule = U'\u2500';

}  // namespace

void draw_box(const Viewport& box, std::string_view title, const Look& look, const Styles& styles,
              CellBuffer& cells) {
  const bool ascii = look.glyphs == GlyphSet::kAscii;
  cells.fill(box.column, box.row, box.size, styles.text);
  const int right = box.column + box.size.columns - 1;
  const int foot = box.row + box.size.rows - 1;
  for (int x = box.column; x <= right; ++x)
    for (const int y : {box.row, foot}) cells.put(x, y, ascii ? U'-' : kThinRule, styles.dim);
  for (int y = box.row; y <= foot; ++y)
    for (const int x : {box.column, right}) cells.put(x, y, ascii ? U'|' : U'\u2502', styles.dim);
  cells.put(box.column, box.row, ascii ? U'+' : U'\u250C', styles.dim);
  cells.put(right, box.row, ascii ? U'+' : U'\u2510', styles.dim);
  cells.put(box.column, foot, ascii ? U'+' : U'\u2514', styles.dim);
  cells.put(right, foot, ascii ? U'+' : U'\u2518', styles.dim);
  const int middle = (box.size.columns - static_cast<int>(title.size()) - 2) / 2;
  if (!title.empty())
    cells.text(box.column + std::max(1, middle), box.row, core::joined({" ", title, " "}), styles.strong);
}

PanelWriter::PanelWriter(const Viewport& panel, const Look& look, const Styles& styles, CellBuffer& cells)
    : panel_(panel), has_sides_(!paints_pixels(look)), styles_(styles), cells_(cells) {
  cells.fill(panel.column, panel.row, panel.size, styles.text);
}

void PanelWriter::title(std::string_view ascii) {
  if (row_ >= panel_.size.rows) return;
  const int row = panel_.row + row_++;
  const int last = panel_.size.columns - 1;
  for (int x = has_sides_ ? 0 : 1; x < (has_sides_ ? last + 1 : last); ++x)
    cells_.put(panel_.column + x, row, has_sides_ ? U'-' : kThinRule, styles_.dim);
  if (has_sides_)
    for (const int x : {0, last}) cells_.put(panel_.column + x, row, U'+', styles_.dim);
  if (!ascii.empty())
    cells_.text(panel_.column + 3, row, core::joined({" ", ascii, " "}), styles_.strong, last - 3);
}

void PanelWriter::begin_row() {
  if (row_ >= panel_.size.rows) return;
  const int row = panel_.row + row_++;
  if (has_sides_)
    for (const int x : {0, panel_.size.columns - 1}) cells_.put(panel_.column + x, row, U'|', styles_.dim);
}

void PanelWriter::text(int column, std::string_view ascii, const Style& style) {
  cells_.text(panel_.column + 2 + column, panel_.row + row_ - 1, ascii, style, width() - column);
}

void PanelWriter::text(int column, std::u32string_view code_points, const Style& style) {
  cells_.text(panel_.column + 2 + column, panel_.row + row_ - 1, code_points, style, width() - column);
}

void PanelWriter::finish() {
  skip_to(panel_.size.rows - 1);
  if (has_sides_) title("");
}

}  // namespace woodlouse::client
