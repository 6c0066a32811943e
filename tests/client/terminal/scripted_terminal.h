// A pseudo-terminal whose other end does what a test says: it answers, late, in halves, nonsense, or not at
// all.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

namespace woodlouse::client {

/// What a terminal that knows everything answers to terminal_questions().
inline const std::string kKnowsAll =
    "\x1b[?0u\x1b[?2026;2$y\x1bP1$r0;48:2::1:2:3m\x1b\\\x1b[5;2R\x1b[5;2R\x1b[?62;22c";

class PseudoTerminal {
 public:
  PseudoTerminal() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    REQUIRE(master_ >= 0);
    REQUIRE(grantpt(master_) == 0);
    REQUIRE(unlockpt(master_) == 0);
    slave_ = open(ptsname(master_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(slave_ >= 0);
  }
  ~PseudoTerminal() {
    close(slave_);
    close(master_);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  [[nodiscard]] int slave() const { return slave_; }
  [[nodiscard]] std::string name() const { return ptsname(master_); }
  void type(const std::string& bytes) const {
    REQUIRE(write(master_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  /// What was written to the terminal, as soon as it ends with or holds `text`; all of it, where it never
  /// does.
  [[nodiscard]] std::string written_until(const std::string& text, std::chrono::milliseconds patience) const {
    std::string result;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (result.find(text) == std::string::npos && std::chrono::steady_clock::now() < end) {
      pollfd readable{master_, POLLIN, 0};
      if (poll(&readable, 1, 10) <= 0) continue;
      char bytes[1024];
      const ssize_t size = read(master_, bytes, sizeof bytes);
      if (size > 0) result.append(bytes, static_cast<std::size_t>(size));
    }
    return result;
  }
  [[nodiscard]] termios settings() const {
    termios result{};
    REQUIRE(tcgetattr(slave_, &result) == 0);
    return result;
  }
  /// Whether something is left for who reads next.
  [[nodiscard]] bool has_input() const {
    pollfd readable{slave_, POLLIN, 0};
    return poll(&readable, 1, 0) > 0;
  }

 private:
  int master_;
  int slave_ = -1;
};

inline bool same(const termios& a, const termios& b) {
  return a.c_iflag == b.c_iflag && a.c_oflag == b.c_oflag && a.c_lflag == b.c_lflag && a.c_cflag == b.c_cflag;
}

}  // namespace woodlouse::client
