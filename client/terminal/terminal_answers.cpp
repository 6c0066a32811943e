#include "client/terminal/terminal_answers.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <string>
#include <variant>

namespace woodlouse::client {
namespace {

constexpr unsigned kSynchronizedMode = 2026;

/// Any form of "background 1, 2, 3": with colons or semicolons, with or without a colour space.
bool has_the_colour(std::string setting) {
  std::replace(setting.begin(), setting.end(), ';', ':');
  return setting.find("48:2:1:2:3") != std::string::npos || setting.find("48:2::1:2:3") != std::string::npos;
}

}  // namespace

std::string_view terminal_questions() {
  // Kitty's flags; 2026; a background as the frames write it, and what became of it; two characters, and
  // where the cursor stands behind each: the first is two letters where bytes are Latin-1. Then all of it is
  // wiped away, with what a terminal that knows no such question may have printed.
  return "\x1b[?u\x1b[?2026$p"
         "\x1b[48;2;1;2;3m\x1bP$qm\x1b\\\x1b[0m"
         "\r\xc3\xa9\x1b[6n\r\xe2\x96\x80\x1b[6n\r\x1b[K"
         "\x1b[c";
}

bool TerminalAnswers::take(const TerminalInput& input) {
  if (std::holds_alternative<DeviceAttributes>(input)) return finished_ = true;
  if (std::holds_alternative<KittyFlags>(input)) return kitty_ = true;
  if (const auto* mode = std::get_if<ModeReport>(&input)) {
    // 3 and 4 can't be changed: it is always so, or never.
    if (mode->mode == kSynchronizedMode) synchronizes_ = mode->state == 1 || mode->state == 2;
    return true;
  }
  if (const auto* setting = std::get_if<SettingReport>(&input)) {
    if (setting->is_known) truecolor_ = has_the_colour(setting->setting);
    return true;
  }
  if (const auto* cursor = std::get_if<CursorReport>(&input)) {
    const bool is_one_wide = cursor->column == 2;
    if (++cursor_reports_ == 1) utf8_ = is_one_wide;
    if (cursor_reports_ == 2) narrow_blocks_ = is_one_wide;
    return true;
  }
  return false;
}

TerminalAnswers await_answers(TerminalGuard& guard, KeySource& keys,
                              std::chrono::steady_clock::time_point end) {
  using std::chrono::steady_clock;
  TerminalAnswers answers;
  while (!answers.is_finished()) {  // what has come already is read, however late it is
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - steady_clock::now());
    pollfd readable{keys.fd, POLLIN, 0};
    const int ready = poll(&readable, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) break;
    std::array<char, 1024> bytes{};
    const ssize_t size = read(keys.fd, bytes.data(), bytes.size());
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (size <= 0) break;  // hung up; whoever reads next is told so
    std::vector<TerminalInput> inputs;
    keys.keyboard.feed({bytes.data(), static_cast<std::size_t>(size)}, steady_clock::now(), inputs);
    for (TerminalInput& input : inputs)
      if (!answers.take(input)) keys.typed.push_back(std::move(input));
  }
  if (answers.is_finished()) guard.note_answer();
  return answers;
}

}  // namespace woodlouse::client
