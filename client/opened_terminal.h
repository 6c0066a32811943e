// The user's terminal before anything is drawn: opened for keys and for frames, asked once what it can do,
// and what it is drawn with after that.
#pragma once

#include <chrono>
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
  /// Opens the terminal behind standard input and output and asks it. From now on, for as long as this lives,
  /// the terminal is the program's: keys come one by one, unseen. Error: there is none.
  static core::Expected<std::unique_ptr<OpenedTerminal>> open();

  /// What it is to be drawn with, by what it has answered; to one that answers late or never a little time is
  /// left since it was asked. Once.
  Look choose(ColorChoice color, GlyphChoice glyphs);
  /// Takes the whole screen, with keys that are reported as well as it can.
  TerminalGuard& fill_screen();
  /// Where frames go.
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
  std::unique_ptr<TerminalGuard> guard_;
  std::chrono::steady_clock::time_point asked_;
  Look look_;
  SynchronizedUpdate synchronized_ = SynchronizedUpdate::kOff;
  bool kitty_ = false;
};

}  // namespace woodlouse::client
