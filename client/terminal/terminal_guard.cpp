#include "client/terminal/terminal_guard.h"

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

namespace woodlouse::client {
namespace {

constexpr std::array kDeadly = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGSEGV, SIGABRT, SIGBUS, SIGILL, SIGFPE};

// alternate screen, no cursor, bracketed paste, focus reports
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l\x1b[?2004h\x1b[?1004h\x1b[0m\x1b[2J";
// The end of a synchronized update comes first: a signal may have cut a frame in two.
constexpr std::string_view kLeave = "\x1b[?2026l\x1b[?1004l\x1b[?2004l\x1b[0m\x1b[?25h\x1b[?1049l";
// Flags 31: press without ambiguity, releases, alternate keys, all keys, their text.
constexpr std::string_view kPushKitty = "\x1b[>31u";
constexpr std::string_view kPopKitty = "\x1b[<u";
constexpr std::string_view kQueryKitty = "\x1b[?u\x1b[c";

// What the handlers need. The only mutable globals of the program: a signal brings no pointer along.
struct Borrowed {
  int input = -1;
  int output = -1;
  TerminalUse use = TerminalUse::kKeysOnly;
  termios saved{};
  volatile std::sig_atomic_t active = 0;  // the terminal is in our state
  volatile std::sig_atomic_t kitty = 0;   // the flags are pushed
  volatile std::sig_atomic_t resumed = 0;
  bool in_use = false;
  std::array<struct sigaction, kDeadly.size()> deadly_before{};
  struct sigaction stop_before {};
  struct sigaction continue_before {};
};
Borrowed borrowed;
alignas(16) std::array<char, 64u << 10> signal_stack;  // a stack overflow leaves no other to run on

void put(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(borrowed.output, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;  // hung up: nobody is left to see it
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

termios raw_of(const termios& saved) {
  termios raw = saved;
  raw.c_lflag &= ~static_cast<tcflag_t>(ECHO | ECHONL | ICANON | IEXTEN);
  raw.c_iflag &= ~static_cast<tcflag_t>(IXON | ICRNL | INLCR | IGNCR | ISTRIP);
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  return raw;
}

void take_terminal() {
  const termios raw = raw_of(borrowed.saved);
  tcsetattr(borrowed.input, TCSANOW, &raw);
  if (borrowed.use == TerminalUse::kFullScreen) put(kEnter);
  if (borrowed.kitty) put(kPushKitty);
  borrowed.active = 1;
}

void give_terminal_back() {
  if (!borrowed.active) return;
  borrowed.active = 0;
  if (borrowed.use == TerminalUse::kFullScreen) {
    tcflush(borrowed.output, TCOFLUSH);  // a terminal that takes nothing must not hold up the leaving
    if (borrowed.kitty) put(kPopKitty);
    put(kLeave);
  }
  tcflush(borrowed.input, TCIFLUSH);  // half-typed keys and late answers are not for the shell
  tcsetattr(borrowed.input, TCSANOW, &borrowed.saved);
}

void on_deadly(int signal) {
  give_terminal_back();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // blocked until this returns; then it does what it does to everyone
}

void on_continue(int) {
  const int saved_errno = errno;
  if (borrowed.active) {  // stopped by SIGSTOP: nothing was given back, but a shell was there since
    borrowed.active = 0;
    const std::sig_atomic_t kitty = borrowed.kitty;
    borrowed.kitty = 0;  // still pushed
    take_terminal();
    borrowed.kitty = kitty;
  } else {
    tcgetattr(borrowed.input, &borrowed.saved);  // what the shell gives us now is what it gets back
    take_terminal();
  }
  borrowed.resumed = 1;
  errno = saved_errno;
}

void install(int signal, void (*handler)(int), struct sigaction* before);

void on_stop(int signal) {
  const int saved_errno = errno;
  give_terminal_back();
  std::signal(signal, SIG_DFL);
  sigset_t only;
  sigset_t mask;
  sigemptyset(&only);
  sigaddset(&only, signal);
  std::raise(signal);
  sigprocmask(SIG_UNBLOCK, &only, &mask);  // stops here; SIGCONT's handler waits until this one returns
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  install(signal, on_stop, nullptr);
  errno = saved_errno;
}

void install(int signal, void (*handler)(int), struct sigaction* before) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  sigfillset(&action.sa_mask);  // one at a time; a fault inside a handler kills all the same
  sigaction(signal, &action, before);
}

}  // namespace

core::Expected<std::unique_ptr<TerminalGuard>> TerminalGuard::enter(int input, int output, TerminalUse use) {
  assert(!borrowed.in_use);
  if (tcgetattr(input, &borrowed.saved) != 0) {
    return core::fail("terminal", std::strerror(errno), "start it from a terminal");
  }
  borrowed.input = input;
  borrowed.output = output;
  borrowed.use = use;
  borrowed.kitty = 0;
  borrowed.resumed = 0;
  borrowed.in_use = true;

  stack_t stack{};
  stack.ss_sp = signal_stack.data();
  stack.ss_size = signal_stack.size();
  sigaltstack(&stack, nullptr);
  for (std::size_t i = 0; i < kDeadly.size(); ++i) install(kDeadly[i], on_deadly, &borrowed.deadly_before[i]);
  install(SIGTSTP, on_stop, &borrowed.stop_before);
  install(SIGCONT, on_continue, &borrowed.continue_before);
  take_terminal();
  return std::unique_ptr<TerminalGuard>(new TerminalGuard());
}

TerminalGuard::~TerminalGuard() {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, &before);
  give_terminal_back();
  for (std::size_t i = 0; i < kDeadly.size(); ++i) sigaction(kDeadly[i], &borrowed.deadly_before[i], nullptr);
  sigaction(SIGTSTP, &borrowed.stop_before, nullptr);
  sigaction(SIGCONT, &borrowed.continue_before, nullptr);
  borrowed.in_use = false;
  sigprocmask(SIG_SETMASK, &before, nullptr);
}

void TerminalGuard::query_kitty() { put(kQueryKitty); }

void TerminalGuard::push_kitty() {
  if (borrowed.kitty) return;
  borrowed.kitty = 1;  // before the bytes: popping what was not pushed does no harm, the reverse does
  put(kPushKitty);
}

void TerminalGuard::suspend() { kill(0, SIGTSTP); }

bool TerminalGuard::take_resumed() {
  const bool was = borrowed.resumed != 0;
  borrowed.resumed = 0;
  return was;
}

Size terminal_size(int fd) {
  winsize size{};
  if (ioctl(fd, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col, size.ws_row};
}

}  // namespace woodlouse::client
