// The loop of whatever plays on a terminal: keys go in, frames come out, 30 times a second. A frame the
// terminal does not take is dropped, never queued; a key brings the next frame forward.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <optional>

#include "client/drawing/compose.h"
#include "client/drawing/scene.h"
#include "client/terminal/key_input.h"
#include "client/terminal/outcome.h"
#include "client/terminal/terminal_guard.h"
#include "client/terminal/terminal_screen.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

/// What is played: a game, a recording. Called from the loop's thread.
class Performance {
 public:
  virtual ~Performance() = default;
  virtual void on_input(const TerminalInput& input) = 0;
  /// Runs on to now and says what is seen then. fps: the frames shown in the last second. What is returned
  /// after finish() is not shown.
  virtual Scene scene(core::Time now, double fps) = 0;
};

class TerminalLoop {
 public:
  /// keys: the terminal to read, taken over. All but keys outlive the loop.
  TerminalLoop(boost::asio::io_context& context, TerminalGuard& guard, KeySource keys, TerminalScreen& screen,
               int fps, Performance& performance);

  /// Until finish().
  Outcome run();
  /// The first call decides how the run ended.
  void finish(Outcome outcome);
  /// Something changed that should be seen at once.
  void hurry();

 private:
  void on_input(const TerminalInput& input);
  void schedule(core::Time at);
  void frame();
  void show(const Scene& scene, core::Time now);
  void flush_when_taken();

  boost::asio::io_context& context_;
  TerminalGuard& guard_;
  TerminalScreen& screen_;
  Performance& performance_;
  int frames_a_second_;
  KeyInput keys_;
  boost::asio::steady_timer timer_;
  boost::asio::posix::stream_descriptor output_;  ///< a duplicate of the screen's, to wait on
  bool flushing_ = false;
  Composer composer_;
  CellBuffer cells_;
  std::optional<Outcome> outcome_;
  core::Time next_frame_{};  ///< on the regular schedule
  core::Time last_frame_{};
  core::Time second_began_{};  ///< of the fps count
  int frames_ = 0;
  double fps_ = 0.0;
};

}  // namespace woodlouse::client
