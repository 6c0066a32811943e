// A recording on a terminal: keys to the screening, its scenes to the screen.
#pragma once

#include <boost/asio/io_context.hpp>

#include "client/play/game.h"
#include "client/terminal/outcome.h"
#include "client/terminal/terminal_loop.h"
#include "client/watch/player.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

class ReplayViewer final : private Performance {
 public:
  /// keys: the terminal to read, taken over. screen: where frames go. All but keys outlive the viewer. name:
  /// of the recording's file.
  ReplayViewer(boost::asio::io_context& context, RecordingView& recording, const std::string& name,
               TerminalGuard& guard, KeySource keys, TerminalScreen& screen, const GameSettings& settings);

  /// Until who watches leaves.
  Outcome run() { return loop_.run(); }

 private:
  static constexpr int kProvingShare = 3;  ///< one part in so many of a frame's time goes to proving ahead

  void on_input(const TerminalInput& input) override;
  Scene scene(core::Time now, double fps) override;

  RecordingView& recording_;
  TerminalGuard& guard_;
  TerminalScreen& screen_;
  GameSettings settings_;
  Screening screening_;
  TerminalLoop loop_;
};

}  // namespace woodlouse::client
