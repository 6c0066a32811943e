// Keys from a terminal, through the io_context: reads bytes as they come, runs the keyboard's state machine
// and its timeouts, hands on what comes out.
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <vector>

#include "client/terminal/keyboard.h"
#include "shared/core/error.h"

namespace woodlouse::client {

/// A descriptor of its own for reading the terminal behind `fd`, or the controlling terminal where `fd` is
/// none: non-blocking, which on `fd` itself would be shared with the shell. The caller closes it.
core::Expected<int> open_terminal_for_keys(int fd);

/// A terminal that keys come from, with what was read of it before it was handed on.
struct KeySource {
  int fd = -1;        ///< readable without blocking
  Keyboard keyboard;  ///< in the middle of a sequence, may be
  std::vector<TerminalInput> typed;
};

class KeyInput {
 public:
  using Handler = std::function<void(const TerminalInput&)>;

  /// Takes over `keys.fd`. `on_input` gets every key; `on_hangup` is called once when the terminal is gone.
  KeyInput(boost::asio::io_context& context, KeySource keys, Handler on_input,
           std::function<void()> on_hangup);

  /// Begins with what was typed before.
  void start();
  void stop();

 private:
  void read();
  void hand_on();
  void await_expiry();

  boost::asio::posix::stream_descriptor terminal_;
  boost::asio::steady_timer expiry_;
  Handler on_input_;
  std::function<void()> on_hangup_;
  Keyboard keyboard_;
  std::array<char, 1024> bytes_{};
  std::vector<TerminalInput> inputs_;
};

}  // namespace woodlouse::client
