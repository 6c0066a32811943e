#include "client/terminal/terminal_screen.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace woodlouse::client {
namespace {

/// A frame below this is drawn by the terminal in one go anyway; the brackets would be a fifth of it.
constexpr std::size_t kWorthSynchronizing = 1024;

bool takes_bytes(int fd) {
  pollfd entry{fd, POLLOUT, 0};
  return ::poll(&entry, 1, 0) == 1 && (entry.revents & (POLLOUT | POLLERR | POLLHUP)) != 0;
}

}  // namespace

TerminalScreen::TerminalScreen(int fd, ColorMode mode, SynchronizedUpdate synchronized)
    : fd_(fd), synchronized_(synchronized), encoder_(mode) {}

FrameResult TerminalScreen::show(const CellBuffer& frame) {
  if (!pending_.empty() && takes_bytes(fd_) && !write_pending()) return FrameResult::kFailed;
  if (!pending_.empty() || !takes_bytes(fd_)) return FrameResult::kDropped;
  pending_ = encoder_.encode(frame);
  if (std::exchange(rings_, false)) pending_ += '\a';
  if (pending_.empty()) return FrameResult::kUnchanged;
  if (synchronized_ == SynchronizedUpdate::kOn && pending_.size() >= kWorthSynchronizing)
    pending_ = "\x1b[?2026h" + pending_ + "\x1b[?2026l";
  return write_pending() ? FrameResult::kShown : FrameResult::kFailed;
}

bool TerminalScreen::flush() {
  // A terminal that is gone takes nothing more; the next show() says so.
  return pending_.empty() || (takes_bytes(fd_) && write_pending() && pending_.empty());
}

bool TerminalScreen::write_pending() {
  ssize_t written = 0;
  do {
    written = ::write(fd_, pending_.data(), pending_.size());
  } while (written < 0 && errno == EINTR);
  if (written < 0) return errno == EAGAIN || errno == EWOULDBLOCK;
  bytes_written_ += static_cast<std::size_t>(written);
  pending_.erase(0, static_cast<std::size_t>(written));
  return true;
}

int open_terminal_for_frames(int fd) {
  const char* name = ::ttyname(fd);
  return name == nullptr ? -1 : ::open(name, O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

}  // namespace woodlouse::client
