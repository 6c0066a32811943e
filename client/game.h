// The game on a terminal: one loop that takes keys, runs the session on and shows a frame, 30 times a second.
// A frame the terminal does not take is dropped, never queued; a key brings the next frame forward.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <optional>

#include "client/chat_entry.h"
#include "client/compose.h"
#include "client/interface.h"
#include "client/key_bindings.h"
#include "client/key_input.h"
#include "client/outcome.h"
#include "client/scene_builder.h"
#include "client/session.h"
#include "client/terminal_guard.h"
#include "client/terminal_screen.h"

namespace woodlouse::client {

struct GameSettings {
  Look look;
  std::optional<View> view;  ///< none: what suits the terminal
  int fps = 30;
  Overlay first = Overlay::kNone;  ///< what lies over the first frame
};

class Game {
 public:
  /// keys: the terminal to read, taken over. screen: where frames go. All but keys outlive the game.
  /// server_alive: whether the server we started ourselves still runs; empty when it is somebody else's.
  Game(boost::asio::io_context& context, Session& session, TerminalGuard& guard, int keys,
       TerminalScreen& screen, const GameSettings& settings, std::function<bool()> server_alive);

  /// Until the player leaves or something ends it.
  Outcome run();

 private:
  void on_input(const TerminalInput& input);
  void on_key(const Key& key);
  void perform(Action action);
  bool drive(Action action);
  void close_chat(ChatEntry::Outcome outcome);

  void schedule(TimePoint at);
  void hurry();
  void frame();
  void show(TimePoint now);
  void flush_when_taken();
  bool server_is_lost(TimePoint now);
  void finish(Outcome outcome);

  boost::asio::io_context& context_;
  Session& session_;
  TerminalGuard& guard_;
  TerminalScreen& screen_;
  GameSettings settings_;
  std::function<bool()> server_alive_;
  KeyInput keys_;
  boost::asio::steady_timer timer_;
  boost::asio::posix::stream_descriptor output_;  ///< a duplicate of the screen's, to wait on
  bool flushing_ = false;
  Composer composer_;
  CellBuffer cells_;
  KeyBindings bindings_;
  Interface interface_;
  ChatEntry chat_;
  std::optional<Outcome> outcome_;
  TimePoint next_frame_{};  ///< on the regular schedule
  TimePoint last_frame_{};
  TimePoint second_began_{};  ///< of the fps count
  TimePoint server_seen_{};   ///< when server_alive_ was last asked
  int frames_ = 0;
  double fps_ = 0.0;
};

}  // namespace woodlouse::client
