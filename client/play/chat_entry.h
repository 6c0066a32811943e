// The line of chat being typed: UTF-8 in, at most as long as the wire allows. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "client/terminal/keyboard.h"

namespace woodlouse::client {

class ChatEntry {
 public:
  enum class Outcome : std::uint8_t { kTyping, kSend, kCancel };

  /// Takes a press or repeat; releases and control keys change nothing.
  Outcome type(const Key& key);
  /// Appends what was pasted, line breaks as spaces, other control characters left out.
  void paste(std::string_view text);
  void clear() { text_.clear(); }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace woodlouse::client
