// The game on a terminal: keys become steering and chat, the session runs on and is seen frame by frame.
#pragma once

#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <functional>
#include <optional>

#include "client/controls/key_bindings.h"
#include "client/controls/repeat_delay.h"
#include "client/play/chat_entry.h"
#include "client/play/interface.h"
#include "client/play/modes/teacher.h"
#include "client/play/scene_builder.h"
#include "client/play/session.h"
#include "client/terminal/outcome.h"
#include "client/terminal/terminal_guard.h"
#include "client/terminal/terminal_loop.h"
#include "client/terminal/terminal_screen.h"
#include "shared/core/clock.h"
#include "shared/state/mode.h"

namespace woodlouse::client {

struct GameSettings {
  Look look;
  std::optional<View> view;  ///< none: what suits the terminal
  int fps = 30;
  Overlay first = Overlay::kNone;  ///< what lies over the first frame
  KeyMap keys{};
  SteerBy steer = SteerBy::kHeading;
  bool bell = false;
  std::filesystem::path data{};  ///< where it is remembered who has had the lesson; empty: nowhere
  /// No key has started it, though any would have: the first one that cruises may have been meant so.
  bool begun_by_itself = false;
};

class Game final : private Performance {
 public:
  /// keys: the terminal to read, taken over. screen: where frames go. All but keys outlive the game.
  /// server_alive: whether the server we started ourselves still runs; empty when it is somebody else's.
  Game(boost::asio::io_context& context, Session& session, TerminalGuard& guard, KeySource keys,
       TerminalScreen& screen, const GameSettings& settings, std::function<bool()> server_alive);

  /// Until the player leaves or something ends it.
  Outcome run();

 private:
  void on_input(const TerminalInput& input) override;
  Scene scene(core::Time now, double fps) override;
  void on_key(const Key& key);
  bool comes_late_to_begin(const Key& key);
  void perform(Action action);
  [[nodiscard]] Handling handling() const;
  void close_chat(ChatEntry::Outcome outcome);
  void check_server(core::Time now);

  Session& session_;
  TerminalGuard& guard_;
  TerminalScreen& screen_;
  GameSettings settings_;
  std::function<bool()> server_alive_;
  KeyBindings bindings_;
  unsigned rung_ = 0;  ///< of the room's bells
  RepeatDelay repeat_delay_;
  Interface interface_;
  state::Mode driven_ = state::Mode::kRoam;  ///< by whose rules; stays when the line is cut
  ChatEntry chat_;
  Teacher teacher_;
  core::Time begun_{};
  core::Time server_seen_{};  ///< when server_alive_ was last asked
  TerminalLoop loop_;
};

}  // namespace woodlouse::client
