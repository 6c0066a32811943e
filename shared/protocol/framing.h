// Cuts a byte stream into lines. No socket, no JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace woodlouse::protocol {

/// Collects bytes and gives out whole lines, without "\n" and without a "\r" before it. A line longer than
/// the limit is passed over up to its newline and reported once, so that the stream can go on or be ended.
class LineFramer {
 public:
  struct Line {
    std::string_view text;  ///< valid until the next call
    bool oversize = false;  ///< it was longer than the limit; text is empty
  };

  explicit LineFramer(std::size_t limit) : limit_(limit) {}

  /// From the next line on that is not yet given out.
  void limit(std::size_t bytes) { limit_ = bytes; }
  void append(std::string_view bytes);
  /// The next whole line, or nothing.
  std::optional<Line> next();

 private:
  std::size_t limit_;
  std::string buffer_;
  std::size_t begin_ = 0;     ///< where the unread part of buffer_ begins
  std::size_t searched_ = 0;  ///< up to here no newline was found
  bool skipping_ = false;     ///< inside a line that is too long
};

}  // namespace woodlouse::protocol
