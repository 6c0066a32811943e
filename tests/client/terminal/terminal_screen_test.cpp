#include "client/terminal/terminal_screen.h"

#include <fcntl.h>
#include <unistd.h>
#include <catch2/catch.hpp>
#include <csignal>
#include <string>

using namespace woodlouse::client;

namespace {

/// A pipe that takes one page and never blocks.
class NarrowPipe {
 public:
  NarrowPipe() {
    REQUIRE(::pipe2(ends_, O_NONBLOCK | O_CLOEXEC) == 0);
    REQUIRE(::fcntl(ends_[1], F_SETPIPE_SZ, 4096) >= 4096);
  }
  ~NarrowPipe() {
    close_reader();
    ::close(ends_[1]);
  }
  NarrowPipe(const NarrowPipe&) = delete;
  NarrowPipe& operator=(const NarrowPipe&) = delete;

  [[nodiscard]] int writer() const { return ends_[1]; }
  void close_reader() {
    if (ends_[0] >= 0) ::close(ends_[0]);
    ends_[0] = -1;
  }
  std::string read_all() {
    std::string result;
    char bytes[4096];
    for (;;) {
      const ssize_t n = ::read(ends_[0], bytes, sizeof bytes);
      if (n <= 0) return result;
      result.append(bytes, static_cast<std::size_t>(n));
    }
  }

 private:
  int ends_[2] = {-1, -1};
};

CellBuffer full_of(char32_t glyph, Size size) {
  CellBuffer cells(size);
  for (int row = 0; row < size.rows; ++row)
    for (int column = 0; column < size.columns; ++column) cells.put(column, row, glyph, {});
  return cells;
}

}  // namespace

TEST_CASE("a terminal that blocks loses frames but ends up with the last one whole") {
  NarrowPipe pipe;
  TerminalScreen screen(pipe.writer(), ColorMode::kMono);
  const Size size{120, 60};  // 7200 bytes: more than the pipe takes
  std::string received;
  FrameEncoder shadow(ColorMode::kMono);
  std::string expected;
  CHECK(screen.show(full_of(U'a', size)) == FrameResult::kShown);
  expected += shadow.encode(full_of(U'a', size));
  CHECK_FALSE(screen.flush());
  CHECK(screen.show(full_of(U'b', size)) == FrameResult::kDropped);
  CHECK(screen.show(full_of(U'c', size)) == FrameResult::kDropped);
  received += pipe.read_all();
  CHECK(screen.flush());
  received += pipe.read_all();
  CHECK(received == expected);
  CHECK(screen.show(full_of(U'd', size)) == FrameResult::kShown);
  expected += shadow.encode(full_of(U'd', size));
  received += pipe.read_all();
  screen.flush();
  received += pipe.read_all();
  CHECK(received == expected);
  CHECK(screen.bytes_written() == received.size());
}

TEST_CASE("an unchanged frame is not written, a forgotten screen is written whole") {
  NarrowPipe pipe;
  TerminalScreen screen(pipe.writer(), ColorMode::kMono);
  const CellBuffer frame = full_of(U'a', {20, 5});
  screen.show(frame);
  const std::string whole = pipe.read_all();
  CHECK(screen.show(frame) == FrameResult::kUnchanged);
  CHECK(pipe.read_all().empty());
  screen.invalidate();
  CHECK(screen.show(frame) == FrameResult::kShown);
  CHECK(pipe.read_all() == whole);
}

TEST_CASE("only big frames are wrapped in a synchronized update") {
  NarrowPipe pipe;
  TerminalScreen screen(pipe.writer(), ColorMode::kMono, SynchronizedUpdate::kOn);
  CellBuffer frame = full_of(U'a', {80, 24});
  screen.show(frame);
  const std::string whole = pipe.read_all();
  CHECK(whole.starts_with("\x1b[?2026h"));
  CHECK(whole.ends_with("\x1b[?2026l"));
  frame.put(3, 3, U'x', {});
  screen.show(frame);
  CHECK(pipe.read_all().find("2026") == std::string::npos);
}

TEST_CASE("the bell is one byte, once, with the next frame or without one") {
  NarrowPipe pipe;
  TerminalScreen screen(pipe.writer(), ColorMode::kMono);
  const CellBuffer frame = full_of(U'a', {20, 5});
  screen.ring();
  screen.show(frame);
  CHECK(pipe.read_all().ends_with('\a'));
  CHECK(screen.show(frame) == FrameResult::kUnchanged);
  screen.ring();
  CHECK(screen.show(frame) == FrameResult::kShown);
  CHECK(pipe.read_all() == "\a");
}

TEST_CASE("a terminal that is gone is reported") {
  std::signal(SIGPIPE, SIG_IGN);
  NarrowPipe pipe;
  TerminalScreen screen(pipe.writer(), ColorMode::kMono);
  pipe.close_reader();
  CHECK(screen.show(full_of(U'a', {20, 5})) == FrameResult::kFailed);
}
