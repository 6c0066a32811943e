// The user's terminal before anything is drawn: opened for keys and for frames, asked once what it can do,
// and what it is drawn with after that.
#pragma once

#include <memory>

#include "client/play/look_choice.h"
#include "client/terminal/descriptor.h"
#include "client/terminal/key_input.h"
#include "client/terminal/terminal_guard.h"
#include "client/terminal/terminal_screen.h"
#include "shared/core/error.h"

namespace woodlouse::client {

class OpenedTerminal {
 public:
  /// Opens the terminal behind standard input and output and asks it, which takes as long as it takes to
  /// answer, 0.6 s at most. Error: there is none.
  static core::Expected<std::unique_ptr<OpenedTerminal>> open(ColorChoice color, GlyphChoice glyphs);

  [[nodiscard]] const Look& look() const { return look_; }
  /// For as long as the guard lives the terminal is the program's. A full screen reports keys as well as it
  /// can.
  core::Expected<std::unique_ptr<TerminalGuard>> enter(TerminalUse use);
  /// Where frames go; once.
  [[nodiscard]] TerminalScreen screen() const;
  /// The keys, for one to take over; once.
  KeySource take_keys();
  /// What was typed while the terminal was asked is still in there.
  [[nodiscard]] KeySource& keys() { return keys_; }

 private:
  OpenedTerminal(int keys, int frames);

  Descriptor key_terminal_;
  Descriptor modes_;  ///< the guard's: outlives whoever takes over the keys, and closes them
  Descriptor frames_;
  KeySource keys_;
  Look look_;
  SynchronizedUpdate synchronized_ = SynchronizedUpdate::kOff;
  bool kitty_ = false;
  bool answers_ = false;  ///< the last question was answered
};

}  // namespace woodlouse::client
