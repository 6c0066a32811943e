#include "client/play/chat_entry.h"

#include <chrono>
#include <variant>
#include <vector>

#include "shared/core/utf8.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {
namespace {

void erase_last_code_point(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

}  // namespace

ChatEntry::Outcome ChatEntry::type(const Key& key) {
  if (key.action == KeyAction::kRelease) return Outcome::kTyping;
  switch (key.code) {
    case KeyCode::kEnter:
      return text_.empty() ? Outcome::kCancel : Outcome::kSend;
    case KeyCode::kEscape:
      return Outcome::kCancel;
    case KeyCode::kBackspace:
      erase_last_code_point(text_);
      return Outcome::kTyping;
    case KeyCode::kCharacter:
      break;
    default:
      return Outcome::kTyping;
  }
  if (key.control && key.character == U'u') text_.clear();
  if (key.control || key.alt) return Outcome::kTyping;
  std::string bytes;
  core::append_character(bytes, key.character);
  if (text_.size() + bytes.size() <= protocol::kMaxChatBytes) text_ += bytes;
  return Outcome::kTyping;
}

void ChatEntry::paste(std::string_view text) {
  // The keyboard's own decoder drops bad UTF-8 and finds the line breaks.
  Keyboard decoder;
  std::vector<TerminalInput> inputs;
  decoder.feed(text, core::Time{}, inputs);
  for (const TerminalInput& input : inputs) {
    const Key* key = std::get_if<Key>(&input);
    if (key == nullptr) continue;
    if (key->code == KeyCode::kCharacter && !key->control) type(*key);
    if (key->code == KeyCode::kEnter || key->code == KeyCode::kTab) type(Key{.character = U' '});
  }
}

}  // namespace woodlouse::client
