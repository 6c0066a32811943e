#include "client/terminal/key_input.h"

#include <fcntl.h>
#include <limits.h>
#include <unistd.h>

#include <boost/asio/buffer.hpp>
#include <cerrno>
#include <cstring>
#include <utility>

namespace woodlouse::client {

using boost::system::error_code;

core::Expected<int> open_terminal_for_keys(int fd) {
  std::array<char, PATH_MAX> name{};
  const bool named = isatty(fd) != 0 && ttyname_r(fd, name.data(), name.size()) == 0;
  for (const char* path : {named ? name.data() : "/dev/tty", "/dev/tty"}) {
    const int opened = open(path, O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (opened >= 0) return opened;
  }
  return core::fail("keyboard", std::strerror(errno), "start it from a terminal");
}

KeyInput::KeyInput(boost::asio::io_context& context, KeySource keys, Handler on_input,
                   std::function<void()> on_hangup)
    : terminal_(context, keys.fd),
      expiry_(context),
      on_input_(std::move(on_input)),
      on_hangup_(std::move(on_hangup)),
      keyboard_(std::move(keys.keyboard)),
      inputs_(std::move(keys.typed)) {}

void KeyInput::start() {
  hand_on();
  if (!terminal_.is_open()) return;
  await_expiry();
  read();
}

void KeyInput::read() {
  terminal_.async_read_some(boost::asio::buffer(bytes_), [this](error_code error, std::size_t size) {
    if (error == boost::asio::error::operation_aborted) return;
    if (error) return on_hangup_();
    keyboard_.feed({bytes_.data(), size}, std::chrono::steady_clock::now(), inputs_);
    hand_on();
    if (!terminal_.is_open()) return;
    await_expiry();
    read();
  });
}

void KeyInput::hand_on() {
  // A handler may stop this input; what is left of the bytes is then nobody's.
  for (const TerminalInput& input : std::exchange(inputs_, {})) {
    if (terminal_.is_open()) on_input_(input);
  }
}

void KeyInput::await_expiry() {
  const auto due = keyboard_.deadline();
  if (!due) return;
  expiry_.expires_at(*due);
  expiry_.async_wait([this](error_code error) {
    if (error) return;
    keyboard_.expire(std::chrono::steady_clock::now(), inputs_);
    hand_on();
  });
}

void KeyInput::stop() {
  error_code nothing_to_do_about_it;
  terminal_.close(nothing_to_do_about_it);
  expiry_.cancel();
}

}  // namespace woodlouse::client
