// Cuts what was read into lines where it lies; keeps but the piece of a line that has not ended yet.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace woodlouse::swarm {

class LineCutter {
 public:
  explicit LineCutter(std::size_t limit) : limit_(limit) {}

  /// Calls take(line) for each line that ends in `bytes`, without its "\n", until it returns false: then the
  /// rest is dropped. The line is valid during the call. False: take() said so, or a line passed the limit.
  template <typename Take>
  bool cut(std::string_view bytes, Take take) {
    while (true) {
      const std::size_t newline = bytes.find('\n');
      const std::string_view piece = bytes.substr(0, newline);
      if (piece_.size() + piece.size() > limit_) return false;
      if (newline == std::string_view::npos) {
        piece_.append(piece);
        return true;
      }
      bytes.remove_prefix(newline + 1);
      if (piece_.empty()) {
        if (!take(piece)) return false;
        continue;
      }
      piece_.append(piece);
      const bool goes_on = take(std::string_view(piece_));
      piece_.clear();
      if (!goes_on) return false;
    }
  }

  /// For another stream from its beginning.
  void reset() { piece_.clear(); }

 private:
  std::size_t limit_;
  std::string piece_;
};

}  // namespace woodlouse::swarm
