// The guard in a process of its own, on a pseudo-terminal: signals end it, and the terminal is what it was.
#include "client/terminal/terminal_guard.h"

#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <array>
#include <csignal>

#include "scripted_terminal.h"

using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

constexpr const char* kEntered = "\x1b[?1049h";
constexpr const char* kLeft = "\x1b[?1049l";

/// Runs `body` in a child whose controlling terminal this is and that has no shell: a session of its own.
template <typename Body>
pid_t in_session_of(const PseudoTerminal& terminal, Body body) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child > 0) return child;
  const rlimit none{};
  setrlimit(RLIMIT_CORE, &none);
  setsid();
  const int fd = open(terminal.name().c_str(), O_RDWR | O_CLOEXEC);
  ioctl(fd, TIOCSCTTY, 0);
  for (int signal = 1; signal < NSIG; ++signal)
    std::signal(signal, SIG_DFL);  // the test's own are not wanted
  const auto guard = TerminalGuard::enter(fd, fd, TerminalUse::kFullScreen);
  if (!guard) _exit(99);
  body(**guard);
  for (;;) pause();
}

bool ends(pid_t child, int& status) {
  for (int i = 0; i < 300; ++i) {
    if (waitpid(child, &status, WNOHANG) == child) return true;
    std::this_thread::sleep_for(10ms);
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return false;
}

}  // namespace

TEST_CASE("every signal that ends a program leaves the terminal as it was, and ends it as it ends any") {
  for (int signal = 1; signal < NSIG; ++signal) {
    const bool is_harmless = signal == SIGKILL || signal == SIGSTOP || signal == SIGTSTP ||
                             signal == SIGTTIN || signal == SIGTTOU || signal == SIGCONT ||
                             signal == SIGCHLD || signal == SIGURG || signal == SIGWINCH;
    if (is_harmless || (signal > 31 && signal < SIGRTMIN)) continue;
    INFO("signal " << signal);
    const PseudoTerminal terminal;
    const termios before = terminal.settings();
    const pid_t child = in_session_of(terminal, [](TerminalGuard&) {});
    REQUIRE(terminal.written_until(kEntered, 3000ms).find(kEntered) != std::string::npos);
    kill(child, signal);
    CHECK(terminal.written_until(kLeft, 3000ms).find(kLeft) != std::string::npos);
    int status = 0;
    REQUIRE(ends(child, status));
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == signal);
    CHECK(same(terminal.settings(), before));
  }
}

TEST_CASE("a signal while the terminal is being taken gives back what was taken of it") {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGUSR1}) {
    INFO("signal " << signal);
    const PseudoTerminal terminal;
    const termios before = terminal.settings();
    const int full = open(terminal.name().c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    while (write(full, "#", 1) == 1) {  // the first bytes of who enters wait
    }
    const pid_t child = in_session_of(terminal, [](TerminalGuard&) {});
    for (int i = 0; i < 1000 && same(terminal.settings(), before); ++i) std::this_thread::sleep_for(10ms);
    CHECK(!same(terminal.settings(), before));
    kill(child, signal);
    int status = 0;
    REQUIRE(ends(child, status));
    CHECK(WIFSIGNALED(status));
    CHECK(same(terminal.settings(), before));
    CHECK(terminal.written_until(kLeft, 3000ms).find(kLeft) != std::string::npos);
    close(full);
  }
}

TEST_CASE(
    "a second signal while the terminal is given back takes nothing from it, whichever thread it meets") {
  for (const auto& [first, second] : {std::pair{SIGINT, SIGINT}, {SIGTERM, SIGINT}, {SIGTSTP, SIGQUIT}}) {
    INFO("signal " << first << ", then " << second);
    const PseudoTerminal terminal;
    const termios before = terminal.settings();
    const pid_t child = in_session_of(terminal, [](TerminalGuard& guard) {
      std::thread([] {
        for (;;) pause();
      }).detach();
      guard.ask("\x1b[c");  // what is not answered is waited for, for a second
    });
    REQUIRE(terminal.written_until("\x1b[c", 3000ms).find(kEntered) != std::string::npos);
    kill(child, first);
    std::this_thread::sleep_for(50ms);
    kill(child, second);
    CHECK(terminal.written_until(kLeft, 3000ms).find(kLeft) != std::string::npos);
    int status = 0;
    REQUIRE(ends(child, status));
    CHECK(WIFSIGNALED(status));
    CHECK(same(terminal.settings(), before));
  }
}

TEST_CASE("who can't be stopped, having no shell, has the screen again at once") {
  const PseudoTerminal terminal;
  const pid_t child = in_session_of(terminal, [](TerminalGuard&) {});
  REQUIRE(terminal.written_until(kEntered, 3000ms).find(kEntered) != std::string::npos);
  const termios raw = terminal.settings();
  kill(child, SIGTSTP);
  CHECK(terminal.written_until(kEntered, 3000ms).find(kEntered) != std::string::npos);
  std::this_thread::sleep_for(10ms);
  CHECK(same(terminal.settings(), raw));
  kill(child, SIGTERM);
  int status = 0;
  CHECK(ends(child, status));
}

TEST_CASE("answers that come late, and reports of releases, are not the shell's") {
  const PseudoTerminal terminal;
  std::thread other([&terminal] {
    (void)terminal.written_until("\x1b[c", 2000ms);
    std::this_thread::sleep_for(150ms);
    terminal.type(kKnowsAll);
  });
  {
    const auto guard = TerminalGuard::enter(terminal.slave(), terminal.slave(), TerminalUse::kFullScreen);
    REQUIRE(guard);
    (*guard)->ask("\x1b[?u\x1b[c");
  }  // left at once
  other.join();
  CHECK_FALSE(terminal.has_input());

  std::thread known([&terminal] {
    (void)terminal.written_until("\x1b[c", 2000ms);
    terminal.type("\x1b[?6c");
    (void)terminal.written_until("\x1b[c", 2000ms);
    terminal.type("\x1b[113;1:3u");
    std::this_thread::sleep_for(100ms);
    terminal.type("\x1b[O\x1b[?6c");
  });
  {
    const auto guard = TerminalGuard::enter(terminal.slave(), terminal.slave(), TerminalUse::kFullScreen);
    REQUIRE(guard);
    (*guard)->ask("\x1b[c");
    std::this_thread::sleep_for(60ms);
    std::array<char, 64> bytes{};
    REQUIRE(read(terminal.slave(), bytes.data(), bytes.size()) > 0);
    (*guard)->note_answer();
  }
  known.join();
  CHECK_FALSE(terminal.has_input());
}

TEST_CASE("a signal's last words reach the server") {
  const PseudoTerminal terminal;
  std::array<int, 2> ends_of_line{};
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends_of_line.data()) == 0);
  const pid_t child = in_session_of(
      terminal, [&](TerminalGuard&) { TerminalGuard::set_last_words(ends_of_line[1], "good-bye\n"); });
  REQUIRE(terminal.written_until(kEntered, 3000ms).find(kEntered) != std::string::npos);
  std::this_thread::sleep_for(20ms);
  kill(child, SIGINT);
  int status = 0;
  CHECK(ends(child, status));
  close(ends_of_line[1]);
  std::array<char, 64> said{};
  CHECK(read(ends_of_line[0], said.data(), said.size()) == 9);
  close(ends_of_line[0]);
}
