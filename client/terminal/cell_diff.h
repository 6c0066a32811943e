// The bytes that turn what a terminal shows into the next frame.
//
// Cells are compared after quantisation, so that a change the terminal cannot show costs nothing. The
// cursor's place and the colours and attributes in force (SGR) are remembered from frame to frame.
#pragma once

#include <string>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"

namespace woodlouse::client {

class FrameEncoder {
 public:
  explicit FrameEncoder(ColorMode mode) : mode_(mode) {}

  /// The bytes; empty when nothing changed. From now on `frame` counts as shown. A frame of another size, and
  /// the first one after invalidate(), is written whole after clearing the screen.
  std::string encode(const CellBuffer& frame);

  void invalidate() { known_ = false; }

 private:
  void move_to(int column, int row, std::string& out);
  void set_style(const Style& style, std::string& out);
  void encode_row(int row, std::string& out);

  ColorMode mode_;
  bool known_ = false;  ///< shown_, cursor and style are what the terminal has
  CellBuffer shown_;    ///< quantised
  CellBuffer next_;     ///< quantised; kept to save the allocation
  CellBuffer given_;    ///< the last frame as it came: a row that is the same is not looked at again
  Style style_;         ///< in force at the terminal
  int cursor_column_ = 0;
  int cursor_row_ = 0;
};

}  // namespace woodlouse::client
