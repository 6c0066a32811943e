#include "shared/protocol/framing.h"

namespace woodlouse::protocol {

void LineFramer::append(std::string_view bytes) {
  buffer_.erase(0, begin_);
  searched_ -= begin_;
  begin_ = 0;
  if (skipping_) {
    const std::size_t newline = bytes.find('\n');
    if (newline == std::string_view::npos) return;
    bytes.remove_prefix(newline + 1);
    skipping_ = false;
  }
  buffer_.append(bytes);
}

std::optional<LineFramer::Line> LineFramer::next() {
  const std::size_t newline = buffer_.find('\n', searched_);
  if (newline == std::string::npos) {
    searched_ = buffer_.size();
    const std::size_t pending = buffer_.size() - begin_;
    // One byte more may be the "\r" of a line that still fits.
    const bool fits = pending <= limit_ || (pending == limit_ + 1 && buffer_.back() == '\r');
    if (fits) return std::nullopt;
    begin_ = buffer_.size();
    skipping_ = true;
    return Line{{}, true};
  }
  std::string_view text(buffer_.data() + begin_, newline - begin_);
  if (text.ends_with('\r')) text.remove_suffix(1);
  begin_ = searched_ = newline + 1;
  if (text.size() > limit_) return Line{{}, true};
  return Line{text, false};
}

}  // namespace woodlouse::protocol
