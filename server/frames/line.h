// One encoded line, newline included: written once, then shared unchanged by all who send it, on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "server/frames/shared_value.h"

namespace woodlouse::server {

using Line = SharedValue<std::string>;

/// Writes lines into the memory of those that nobody holds any more. One owner; its lines go to any thread.
class LinePool {
 public:
  /// longest: a new line that takes more bytes than this is not kept.
  explicit LinePool(std::size_t longest = SIZE_MAX) : longest_(longest) {}

  /// write(std::string&) appends the text.
  template <typename Write>
  Line line(const Write& write) {
    const auto fill = [&write](std::string& text) {
      text.clear();
      write(text);
    };
    return pool_.make(fill, [this](const std::string& text) { return text.capacity() <= longest_; });
  }

 private:
  SharedPool<std::string> pool_;
  std::size_t longest_;
};

}  // namespace woodlouse::server
