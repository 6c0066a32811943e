// Borrows the user's terminal and gives it back exactly as it was, whatever happens: at the end of scope, on
// every signal that ends a program (after which the signal does what it always does), and over TSTP/CONT.
// Everything a signal handler does here is async-signal-safe: tcsetattr, tcgetattr, poll, read, write, send,
// pthread_kill. What comes to another thread is passed on to the one that entered the terminal.
//
// Ctrl-C and Ctrl-Z stay the terminal driver's, so that they work on a program that hangs.
//
// What a terminal was asked it may answer late. It is given back once the answer to a last question has come,
// so that no answer, and no report of a key's release, ends up as input of the shell.
#pragma once

#include <memory>
#include <string_view>

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

  /// From kKeysOnly to kFullScreen, with what was asked and answered so far.
  void fill_screen();
  /// Writes questions whose last is the one for device attributes (CSI c), which every terminal answers. The
  /// answers come as keys do.
  void ask(std::string_view questions);
  /// The answer to that last question has come; of this terminal before it was entered, too: so it is one
  /// that answers.
  void note_answer();
  /// Of a terminal that speaks the kitty keyboard protocol: from now on it reports presses, repeats and
  /// releases. Undone with everything else.
  void push_kitty();
  /// Stops the process group as Ctrl-Z would; returns when it is continued, or at once where nobody could (no
  /// shell with job control waits for it).
  void suspend();
  /// Whether the process was stopped and continued since the last call: the screen must be written whole.
  [[nodiscard]] bool take_resumed();
  /// What a signal that ends the program still sends to `socket`: `words` must live for ever. -1: nothing.
  static void set_last_words(int socket, std::string_view words);
  /// Has INT, TERM and HUP say them where no terminal was entered, nor will be.
  static void speak_without_terminal();

 private:
  TerminalGuard() = default;
};

/// The size of the terminal behind a descriptor; {0, 0} when it is none.
Size terminal_size(int fd);

}  // namespace woodlouse::client
