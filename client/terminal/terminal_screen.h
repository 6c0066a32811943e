// Frames on a terminal: the difference to what is shown, as one string of bytes, in one write.
//
// It writes cursor positions, colours and text only; entering the alternate screen, hiding the cursor and
// restoring the terminal are the caller's (the terminal guard's).
#pragma once

#include <string>

#include "client/cells/cell_buffer.h"
#include "client/cells/color.h"
#include "client/terminal/cell_diff.h"
#include "client/terminal/screen.h"

namespace woodlouse::client {

/// Whether big frames are wrapped in a synchronized update (mode 2026), which only some terminals know.
enum class SynchronizedUpdate : std::uint8_t { kOff, kOn };

class TerminalScreen final : public Screen {
 public:
  /// fd: where to write, not owned. Best opened by open_terminal_for_frames(): on a blocking descriptor a
  /// frame larger than the terminal's buffer waits for the terminal. The caller ignores SIGPIPE where fd may
  /// be a pipe.
  TerminalScreen(int fd, ColorMode mode, SynchronizedUpdate synchronized = SynchronizedUpdate::kOff);

  FrameResult show(const CellBuffer& frame) override;
  /// Rings the terminal's bell with the next frame.
  void ring() { rings_ = true; }
  void invalidate() override { encoder_.invalidate(); }

  /// Writes what is left of the last frame, as far as the terminal takes it. False: still something left.
  bool flush();
  /// The descriptor to wait on while flush() says false.
  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] std::size_t bytes_written() const { return bytes_written_; }

 private:
  /// Writes as much of pending_ as goes; false when the terminal is gone.
  bool write_pending();

  int fd_;
  SynchronizedUpdate synchronized_;
  FrameEncoder encoder_;
  bool rings_ = false;
  std::string pending_;  ///< bytes of the last frame the terminal has not taken; at most one frame
  std::size_t bytes_written_ = 0;
};

/// A descriptor of its own, non-blocking, for the terminal behind `fd` (O_NONBLOCK on `fd` itself would be
/// shared with the shell). -1: `fd` is no terminal that can be opened; write to `fd` then. The caller closes
/// it.
int open_terminal_for_frames(int fd);

}  // namespace woodlouse::client
