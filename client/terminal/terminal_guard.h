// Borrows the user's terminal and gives it back exactly as it was, whatever happens: at the end of scope, on
// SIGINT, TERM, HUP, QUIT, SEGV, ABRT, BUS, ILL, FPE (after which the signal does what it always does), and
// over TSTP/CONT. Everything a signal handler does here is async-signal-safe: tcsetattr, tcgetattr, write.
//
// Ctrl-C and Ctrl-Z stay the terminal driver's, so that they work on a program that hangs.
#pragma once

#include <memory>

#include "client/cells/cell_buffer.h"
#include "shared/core/error.h"

namespace woodlouse::client {

enum class TerminalUse : std::uint8_t {
  kFullScreen,  ///< alternate screen, no cursor, bracketed paste and focus reports
  kKeysOnly,    ///< keys byte by byte without echo; the screen scrolls as always
};

/// One at a time in a program: signals have no `this`.
class TerminalGuard {
 public:
  /// input: the terminal keys come from; output: where it is written to, blocking. Both stay open for the
  /// guard's life and are not owned. Error: input is no terminal.
  static core::Expected<std::unique_ptr<TerminalGuard>> enter(int input, int output, TerminalUse use);
  ~TerminalGuard();
  TerminalGuard(const TerminalGuard&) = delete;
  TerminalGuard& operator=(const TerminalGuard&) = delete;

  /// Asks whether the terminal speaks the kitty keyboard protocol; the answer comes as a key would.
  void query_kitty();
  /// It does: from now on it reports presses, repeats and releases. Undone with everything else.
  void push_kitty();
  /// Stops the process group as Ctrl-Z would; returns when it is continued.
  void suspend();
  /// Whether the process was stopped and continued since the last call: the screen must be written whole.
  [[nodiscard]] bool take_resumed();

 private:
  TerminalGuard() = default;
};

/// The size of the terminal behind a descriptor; {0, 0} when it is none.
Size terminal_size(int fd);

}  // namespace woodlouse::client
