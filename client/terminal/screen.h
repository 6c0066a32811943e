// Where frames go: a terminal, or memory for tests.
#pragma once

#include <cstddef>
#include <cstdint>

#include "client/cells/cell_buffer.h"

namespace woodlouse::client {

/// What became of a frame.
enum class FrameResult : std::uint8_t {
  kShown,      ///< written, wholly or with a rest that will follow (see Screen::flush)
  kUnchanged,  ///< equal to what is shown: nothing was written
  kDropped,    ///< the terminal has not taken the last frame yet: this one is forgotten, not queued
  kFailed,     ///< the terminal is gone (hung up, closed): leave
};

/// Single thread.
class Screen {
 public:
  virtual ~Screen() = default;

  /// Makes the screen look like `frame`. Never blocks.
  virtual FrameResult show(const CellBuffer& frame) = 0;

  /// Forgets what is shown: the next frame is written whole. After a resize of the same size, a resume from
  /// suspension, or whenever somebody else may have written on the terminal.
  virtual void invalidate() = 0;
};

}  // namespace woodlouse::client
