#include "client/terminal/terminal_guard.h"

#include <poll.h>
#include <pthread.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>

namespace woodlouse::client {
namespace {

/// All others end a program that does not mind them; so will those that a later system has.
constexpr std::array kHarmless = {SIGKILL, SIGSTOP, SIGTSTP, SIGTTIN, SIGTTOU,
                                  SIGCONT, SIGCHLD, SIGURG,  SIGWINCH};
constexpr int kSignals = NSIG;  // with those of real time

constexpr bool is_deadly(int signal) {
  return std::find(kHarmless.begin(), kHarmless.end(), signal) == kHarmless.end();
}

// How long an answer is waited for before the terminal is given back: since it was asked at the start, where
// nothing was ever answered, and for a last question, of a terminal that answers.
constexpr std::chrono::milliseconds kFirstAnswer{1000};
constexpr std::chrono::milliseconds kLastAnswer{1000};

// alternate screen, no cursor, bracketed paste, focus reports
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l\x1b[?2004h\x1b[?1004h\x1b[0m\x1b[2J";
// The end of a synchronized update comes first: a signal may have cut a frame in two. And before it a
// beginning: some terminals complain of an end of what has not begun.
constexpr std::string_view kQuiet = "\x1b[?2026h\x1b[?2026l\x1b[?1004l\x1b[?2004l\x1b[0m";
constexpr std::string_view kLeave = "\x1b[?25h\x1b[?1049l";
// Flags 31: press without ambiguity, releases, alternate keys, all keys, their text.
constexpr std::string_view kPushKitty = "\x1b[>31u";
constexpr std::string_view kPopKitty = "\x1b[<u";
constexpr std::string_view kLastQuestion = "\x1b[c";

// What the handlers need. The only mutable globals of the program: a signal brings no pointer along.
struct Borrowed {
  int input = -1;
  int output = -1;
  TerminalUse use = TerminalUse::kKeysOnly;
  termios saved{};
  volatile std::sig_atomic_t active = 0;  // the terminal is in our state
  volatile std::sig_atomic_t kitty = 0;   // the flags are pushed
  volatile std::sig_atomic_t resumed = 0;
  volatile std::sig_atomic_t unanswered = 0;  // last questions without an answer yet
  volatile std::sig_atomic_t answers = 0;     // it has answered one
  std::chrono::steady_clock::time_point asked{};
  volatile std::sig_atomic_t socket = -1;  // for the last words
  std::string_view last_words;
  pthread_t thread{};  // the terminal's: the one that entered it
  bool in_use = false;
  std::array<struct sigaction, kSignals> deadly_before{};
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

/// Finds CSI ? ... c, the answer to a last question, in bytes as they come.
class AnswerFinder {
 public:
  bool take(char byte) {
    if (byte == '\x1b')
      found_ = 1;
    else if (found_ < 3)
      found_ = byte == "\x1b[?"[found_] ? found_ + 1 : 0;
    else if (byte == 'c')
      return found_ = 0, true;
    else if (byte < '0' || byte > ';')
      found_ = 0;
    return false;
  }

 private:
  std::size_t found_ = 0;  // bytes of the beginning
};

/// Reads away what the terminal still has to say.
void drain() {
  using std::chrono::steady_clock;
  if (borrowed.use == TerminalUse::kFullScreen && borrowed.answers) {
    put(kLastQuestion);
    borrowed.unanswered = borrowed.unanswered + 1;
  }
  const auto end = borrowed.answers ? steady_clock::now() + kLastAnswer : borrowed.asked + kFirstAnswer;
  AnswerFinder finder;
  while (borrowed.unanswered > 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - steady_clock::now());
    pollfd readable{borrowed.input, POLLIN, 0};
    if (left.count() <= 0 || poll(&readable, 1, static_cast<int>(left.count())) <= 0) break;
    std::array<char, 256> bytes{};
    const ssize_t size = read(borrowed.input, bytes.data(), bytes.size());
    if (size <= 0) break;  // hung up, or another one's foreground
    for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i)
      if (finder.take(bytes[i])) borrowed.unanswered = borrowed.unanswered - 1;
  }
  borrowed.unanswered = 0;
}

/// Whether this program has the terminal, not somebody whom the shell has put before it.
bool is_in_foreground() {
  const pid_t group = tcgetpgrp(borrowed.input);
  return group < 0 || group == getpgrp();
}

void take_terminal() {
  borrowed.active = 1;  // before anything is taken: giving back what was not does no harm, the reverse does
  const termios raw = raw_of(borrowed.saved);
  tcsetattr(borrowed.input, TCSANOW, &raw);
  if (borrowed.use == TerminalUse::kFullScreen) put(kEnter);
  if (borrowed.kitty) put(kPushKitty);
}

void give_terminal_back() {
  if (!borrowed.active) return;
  borrowed.active = 0;
  if (borrowed.use == TerminalUse::kFullScreen) {
    // A terminal that takes nothing must not hold up the leaving; of one that does nothing is lost, questions
    // above all.
    pollfd writable{borrowed.output, POLLOUT, 0};
    if (poll(&writable, 1, 0) == 0) tcflush(borrowed.output, TCOFLUSH);
    if (borrowed.kitty) put(kPopKitty);
    put(kQuiet);
  }
  drain();
  tcflush(borrowed.input, TCIFLUSH);  // half-typed keys are not for the shell
  tcsetattr(borrowed.input, TCSANOW, &borrowed.saved);
  // Last: who sees the shell's screen may type.
  if (borrowed.use == TerminalUse::kFullScreen) put(kLeave);
}

/// What a thread does to itself is its own to end.
constexpr std::array kFaults = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP, SIGSYS};

/// A signal comes to whichever thread does not block it: a library's too, while the terminal's gives it back.
/// There alone it is dealt with, behind what is going on.
bool is_passed_on(int signal) {
  if (pthread_equal(pthread_self(), borrowed.thread) != 0) return false;
  if (std::find(kFaults.begin(), kFaults.end(), signal) != kFaults.end()) return false;
  pthread_kill(borrowed.thread, signal);
  return true;
}

void on_deadly(int signal) {
  if (is_passed_on(signal)) return;
  if (borrowed.socket >= 0)
    send(borrowed.socket, borrowed.last_words.data(), borrowed.last_words.size(),
         MSG_DONTWAIT | MSG_NOSIGNAL);
  give_terminal_back();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // blocked until this returns; then it does what it does to everyone
}

void on_continue(int signal) {
  if (is_passed_on(signal)) return;
  const int saved_errno = errno;
  if (!is_in_foreground()) {  // by `bg`: the terminal is the shell's; stopped again until it is ours
    std::raise(SIGTTOU);
  } else if (borrowed.active) {  // stopped by SIGSTOP: nothing was given back, but a shell was there since
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
  if (is_passed_on(signal)) return;
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
  sigset_t waiting;
  sigpending(&waiting);
  if (!sigismember(&waiting, SIGCONT)) {  // nobody could continue it, so the system did not stop it
    take_terminal();
    borrowed.resumed = 1;
  }
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
  borrowed.thread = pthread_self();
  borrowed.input = input;
  borrowed.output = output;
  borrowed.use = use;
  borrowed.kitty = 0;
  borrowed.resumed = 0;
  borrowed.unanswered = 0;
  borrowed.answers = 0;
  borrowed.in_use = true;

  stack_t stack{};
  stack.ss_sp = signal_stack.data();
  stack.ss_size = signal_stack.size();
  sigaltstack(&stack, nullptr);
  for (int signal = 1; signal < kSignals; ++signal) {
    struct sigaction& before = borrowed.deadly_before[static_cast<std::size_t>(signal)];
    before = {};
    before.sa_handler = SIG_IGN;
    if (!is_deadly(signal) || sigaction(signal, nullptr, &before) != 0)
      continue;                                                             // two are the C library's own
    if (before.sa_handler != SIG_IGN) install(signal, on_deadly, nullptr);  // nohup's stay ignored
  }
  install(SIGTSTP, on_stop, &borrowed.stop_before);
  install(SIGCONT, on_continue, &borrowed.continue_before);
  take_terminal();
  return std::unique_ptr<TerminalGuard>(new TerminalGuard());
}

TerminalGuard::~TerminalGuard() {
  sigset_t all;
  sigset_t mask;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, &mask);
  give_terminal_back();
  for (int signal = 1; signal < kSignals; ++signal) {
    const struct sigaction& before = borrowed.deadly_before[static_cast<std::size_t>(signal)];
    if (before.sa_handler != SIG_IGN) sigaction(signal, &before, nullptr);
  }
  sigaction(SIGTSTP, &borrowed.stop_before, nullptr);
  sigaction(SIGCONT, &borrowed.continue_before, nullptr);
  borrowed.in_use = false;
  sigprocmask(SIG_SETMASK, &mask, nullptr);
}

void TerminalGuard::fill_screen() {
  assert(borrowed.use == TerminalUse::kKeysOnly);
  borrowed.use = TerminalUse::kFullScreen;  // before the bytes: leaving what was not entered does no harm
  put(kEnter);
}

void TerminalGuard::ask(std::string_view questions) {
  assert(questions.ends_with(kLastQuestion));
  borrowed.asked = std::chrono::steady_clock::now();
  borrowed.unanswered = borrowed.unanswered + 1;
  put(questions);
}

void TerminalGuard::note_answer() {
  borrowed.answers = 1;
  if (borrowed.unanswered > 0) borrowed.unanswered = borrowed.unanswered - 1;
}

void TerminalGuard::set_last_words(int socket, std::string_view words) {
  borrowed.socket = -1;  // a signal between the two finds nothing
  borrowed.last_words = words;
  borrowed.socket = socket;
}

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

void TerminalGuard::speak_without_terminal() {
  assert(!borrowed.in_use);
  borrowed.thread = pthread_self();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      install(signal, on_deadly, nullptr);
  }
}

Size terminal_size(int fd) {
  winsize size{};
  if (ioctl(fd, TIOCGWINSZ, &size) != 0) return {};
  return {size.ws_col, size.ws_row};
}

}  // namespace woodlouse::client
