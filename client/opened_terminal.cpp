#include "client/opened_terminal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cassert>
#include <utility>

#include "client/terminal/terminal_answers.h"

namespace woodlouse::client {
namespace {

constexpr std::chrono::milliseconds kPatience{
    500};  // with a terminal that answers nothing, since it was asked

}  // namespace

OpenedTerminal::OpenedTerminal(int keys, int frames)
    : key_terminal_(keys), modes_(fcntl(keys, F_DUPFD_CLOEXEC, 0)), frames_(frames), keys_{keys, {}, {}} {}

core::Expected<std::unique_ptr<OpenedTerminal>> OpenedTerminal::open() {
  const auto keys = open_terminal_for_keys(STDIN_FILENO);
  if (!keys) return tl::unexpected(keys.error());
  std::unique_ptr<OpenedTerminal> opened(new OpenedTerminal(*keys, open_terminal_for_frames(STDOUT_FILENO)));
  auto guard = TerminalGuard::enter(opened->modes_.get(), STDOUT_FILENO, TerminalUse::kKeysOnly);
  if (!guard) return tl::unexpected(guard.error());
  opened->guard_ = std::move(*guard);
  opened->guard_->ask(terminal_questions());
  opened->asked_ = std::chrono::steady_clock::now();
  return opened;
}

Look OpenedTerminal::choose(ColorChoice color, GlyphChoice glyphs) {
  assert(guard_ != nullptr);
  const TerminalAnswers answers = await_answers(*guard_, keys_, asked_ + kPatience);
  look_ = choose_look(color, glyphs, hints_of_environment(), answers);
  synchronized_ = answers.synchronizes() ? SynchronizedUpdate::kOn : SynchronizedUpdate::kOff;
  kitty_ = answers.kitty();
  return look_;
}

TerminalGuard& OpenedTerminal::fill_screen() {
  assert(guard_ != nullptr);
  guard_->fill_screen();
  if (kitty_) guard_->push_kitty();
  return *guard_;
}

TerminalScreen OpenedTerminal::screen() const {
  return {frames_.get() >= 0 ? frames_.get() : STDOUT_FILENO, look_.color, synchronized_};
}

KeySource OpenedTerminal::take_keys() {
  assert(key_terminal_.get() >= 0);
  key_terminal_.release();
  return std::exchange(keys_, {});
}

}  // namespace woodlouse::client
