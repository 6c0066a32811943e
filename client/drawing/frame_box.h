// Boxes of text: `+-- TITLE ---+` and `|` in ASCII, thin rules where the terminal has the characters.
#pragma once

#include <string>
#include <string_view>

#include "client/cells/cell_buffer.h"
#include "client/drawing/layout.h"
#include "client/drawing/palette.h"
#include "client/drawing/scene.h"

namespace woodlouse::client {

/// A frame around `box`, its inside blank; the title stands in the upper edge.
void draw_box(const Viewport& box, std::string_view title, const Look& look, const Styles& styles,
              CellBuffer& cells);

/// Writes the side panel from top to bottom.
class PanelWriter {
 public:
  PanelWriter(const Viewport& panel, const Look& look, const Styles& styles, CellBuffer& cells);

  /// Columns between the frame's sides.
  [[nodiscard]] int width() const { return panel_.size.columns - 4; }
  [[nodiscard]] int rows_used() const { return row_; }

  void title(std::string_view ascii);
  /// Begins the next row, framed; text() writes into it.
  void begin_row();
  void text(int column, std::string_view ascii, const Style& style);
  void text(int column, std::u32string_view code_points, const Style& style);
  void line(std::string_view ascii, const Style& style) { begin_row(), text(0, ascii, style); }
  /// Empty rows until `row` are used.
  void skip_to(int row) {
    while (row_ < row) begin_row();
  }
  /// Empty rows to the foot, and the foot.
  void finish();

 private:
  Viewport panel_;
  bool has_sides_;
  const Styles& styles_;
  CellBuffer& cells_;
  int row_ = 0;  ///< rows written
};

}  // namespace woodlouse::client
