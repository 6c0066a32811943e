// What a terminal says of itself when it is asked. One round of questions, the last of which every terminal
// answers (primary device attributes): what was not answered before it never will be. Where nothing is
// answered the names in the environment have to do (look_choice.h).
#pragma once

#include <chrono>
#include <optional>
#include <string_view>
#include <vector>

#include "client/terminal/key_input.h"
#include "client/terminal/keyboard.h"
#include "client/terminal/terminal_guard.h"

namespace woodlouse::client {

/// Pure: inputs in, what they say out.
class TerminalAnswers {
 public:
  /// Whether `input` is an answer, no key.
  bool take(const TerminalInput& input);

  /// The last question is answered.
  [[nodiscard]] bool is_finished() const { return finished_; }
  /// A colour set as red, green and blue is one; nothing: not answered.
  [[nodiscard]] std::optional<bool> truecolor() const { return truecolor_; }
  /// Bytes of UTF-8 are characters.
  [[nodiscard]] std::optional<bool> utf8() const { return utf8_; }
  /// Half-blocks are as wide as a letter; where East Asian width rules they are not.
  [[nodiscard]] std::optional<bool> narrow_blocks() const { return narrow_blocks_; }
  /// Synchronized updates (mode 2026) are known.
  [[nodiscard]] bool synchronizes() const { return synchronizes_; }
  /// The kitty keyboard protocol is spoken.
  [[nodiscard]] bool kitty() const { return kitty_; }

 private:
  int cursor_reports_ = 0;
  std::optional<bool> truecolor_, utf8_, narrow_blocks_;
  bool synchronizes_ = false;
  bool kitty_ = false;
  bool finished_ = false;
};

/// The questions, as bytes. They write on the cursor's line and leave it empty.
std::string_view terminal_questions();

/// Waits for the answers to terminal_questions(), which `guard` has asked, until `end` at most. What was
/// typed meanwhile, and what is left of an answer that is cut in two, waits in `keys`. guard: has the
/// terminal of `keys`.
TerminalAnswers await_answers(TerminalGuard& guard, KeySource& keys,
                              std::chrono::steady_clock::time_point end);

}  // namespace woodlouse::client
