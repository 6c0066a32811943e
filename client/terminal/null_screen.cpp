#include "client/terminal/null_screen.h"

#include "shared/core/utf8.h"

namespace woodlouse::client {

FrameResult NullScreen::show(const CellBuffer& frame) {
  if (frame == last_) return FrameResult::kUnchanged;
  last_ = frame;
  ++frames_;
  return FrameResult::kShown;
}

std::string NullScreen::text() const {
  std::string result;
  for (int row = 0; row < last_.size().rows; ++row) {
    std::u32string line;
    for (const Cell& cell : last_.row(row)) line.push_back(cell.glyph);
    while (!line.empty() && line.back() == U' ') line.pop_back();
    for (const char32_t c : line) core::append_character(result, c);
    result += '\n';
  }
  return result;
}

}  // namespace woodlouse::client
