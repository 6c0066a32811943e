// A screen that only remembers: for tests, and for drawing pictures without a terminal.
#pragma once

#include <cstddef>
#include <string>

#include "client/terminal/screen.h"

namespace woodlouse::client {

class NullScreen final : public Screen {
 public:
  FrameResult show(const CellBuffer& frame) override;
  void invalidate() override { last_ = CellBuffer(); }

  [[nodiscard]] const CellBuffer& last() const { return last_; }
  [[nodiscard]] std::size_t frames() const { return frames_; }
  /// The last frame's characters as UTF-8 lines, each ending in a newline; trailing blanks left out.
  [[nodiscard]] std::string text() const;

 private:
  CellBuffer last_;
  std::size_t frames_ = 0;
};

}  // namespace woodlouse::client
