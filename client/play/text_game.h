// The game as lines of text, for a screen reader or a pipe: events as they come, states at intervals. Plays
// with the same keys where there is a terminal to read them from; watches without one.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/controls/driving.h"
#include "client/controls/key_bindings.h"
#include "client/controls/repeat_delay.h"
#include "client/play/chat_entry.h"
#include "client/play/ground_words.h"
#include "client/play/modes/teacher.h"
#include "client/play/session.h"
#include "client/play/spoken_words.h"
#include "client/terminal/key_input.h"
#include "client/terminal/outcome.h"
#include "shared/core/clock.h"

namespace woodlouse::client {

class TextGame {
 public:
  /// How it is driven.
  struct Manner {
    KeyMap keys{};
    SteerBy steer = SteerBy::kHeading;
    std::filesystem::path data{};  ///< where it is remembered who has had the lesson; empty: nowhere
  };
  using Write = std::function<bool(const std::string& line)>;  ///< false: nobody reads any more

  /// keys: a terminal to read, taken over; -1: none.
  TextGame(boost::asio::io_context& context, Session& session, int keys, Write write, const Manner& manner,
           std::function<bool()> server_alive);

  Outcome run();

 private:
  static constexpr std::chrono::milliseconds kUpdate{50};
  static constexpr std::chrono::seconds kStateEvery{2};
  static constexpr std::chrono::seconds kErrorEvery{10};  ///< a window of the twin

  void update();
  void on_key(const Key& key);
  void perform(Action action);
  void tell_driving(Action action, core::Time now);
  void tell_news();
  void tell_ground(core::Time now);
  void read_ground();
  void tell_connection();
  void tell_silence(core::Time now);
  void tell_proof();
  void tell_error(core::Time now);
  void ask_error(core::Time now);
  void teach();
  /// With what is played.
  void tell_keys();
  void tell_podium();
  void say(const std::string& line);
  void finish(Outcome outcome);

  boost::asio::io_context& context_;
  Session& session_;
  Write write_;
  std::function<bool()> server_alive_;
  std::optional<KeyInput> keys_;
  boost::asio::steady_timer timer_;
  KeyBindings bindings_;
  RepeatDelay repeat_delay_;
  GroundTeller ground_;
  SteerBy steer_;
  std::string driving_told_;
  core::Time driving_told_until_{};  ///< until then the same is not told again
  ChatEntry chat_;
  Teacher teacher_;
  bool chatting_ = false;
  bool asked_ = false;          ///< Q was pressed and is to be confirmed
  std::size_t lines_told_ = 0;  ///< of the roster's
  std::string notice_told_;
  bool is_difference_told_ = false;  ///< of the re-run
  bool is_silence_told_ = false;
  std::optional<std::uint32_t> podium_told_;  ///< of which round
  int losses_told_ = 0;                       ///< of the connection's
  core::Time state_told_{};
  bool asks_error_ = false;
  core::Time error_told_{};
  std::vector<std::string> standing_told_;  ///< the last time
  std::optional<Outcome> outcome_;
};

}  // namespace woodlouse::client
