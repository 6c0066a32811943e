#include "client/opened_terminal.h"

#include <unistd.h>

#include <cassert>
#include <chrono>
#include <utility>

#include "client/terminal/terminal_answers.h"

namespace woodlouse::client {
namespace {

constexpr std::chrono::milliseconds kPatience{600};  // with a terminal that answers nothing, at each start

}  // namespace

OpenedTerminal::OpenedTerminal(int keys, int frames)
    : key_terminal_(keys), modes_(dup(keys)), frames_(frames), keys_{keys, {}, {}} {}

core::Expected<std::unique_ptr<OpenedTerminal>> OpenedTerminal::open(ColorChoice color, GlyphChoice glyphs) {
  const auto keys = open_terminal_for_keys(STDIN_FILENO);
  if (!keys) return tl::unexpected(keys.error());
  std::unique_ptr<OpenedTerminal> opened(new OpenedTerminal(*keys, open_terminal_for_frames(STDOUT_FILENO)));
  const TerminalHints hints = hints_of_environment();
  TerminalAnswers answers;
  {
    const auto guard = opened->enter(TerminalUse::kKeysOnly);
    if (!guard) return tl::unexpected(guard.error());
    answers = ask_terminal(**guard, opened->keys_, kPatience);
  }
  opened->look_ = choose_look(color, glyphs, hints, answers);
  opened->synchronized_ = answers.synchronizes() ? SynchronizedUpdate::kOn : SynchronizedUpdate::kOff;
  opened->kitty_ = answers.kitty();
  opened->answers_ = answers.is_finished();
  return opened;
}

core::Expected<std::unique_ptr<TerminalGuard>> OpenedTerminal::enter(TerminalUse use) {
  auto guard = TerminalGuard::enter(modes_.get(), STDOUT_FILENO, use);
  if (guard && answers_) (*guard)->note_answer();
  if (guard && use == TerminalUse::kFullScreen && kitty_) (*guard)->push_kitty();
  return guard;
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
