#include "client/terminal/null_screen.h"

#include "client/cells/character_width.h"
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
    const auto cells = last_.row(row);
    for (std::size_t i = 0; i < cells.size(); ++i) line.push_back(whole_cell(cells, i).glyph);
    std::erase(line, kWideTail);
    while (!line.empty() && line.back() == U' ') line.pop_back();
    for (const char32_t c : line) core::append_character(result, c);
    result += '\n';
  }
  return result;
}

}  // namespace woodlouse::client
