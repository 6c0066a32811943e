#include "client/terminal/keyboard.h"

#include <algorithm>

#include "client/terminal/csi_sequence.h"

namespace woodlouse::client {
namespace {

constexpr unsigned char kEscapeByte = 0x1b;
constexpr std::string_view kPasteEnd = "\x1b[201~";

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

}  // namespace

void Keyboard::feed(std::string_view bytes, core::Time now, std::vector<TerminalInput>& out) {
  for (const char c : bytes) take(static_cast<unsigned char>(c), out);
  last_byte_ = now;
}

std::optional<core::Time> Keyboard::deadline() const {
  switch (state_) {
    case State::kGround:
      return std::nullopt;
    case State::kEscape:
      return last_byte_ + kEscapeTimeout;
    default:
      return last_byte_ + kSequenceTimeout;
  }
}

void Keyboard::expire(core::Time now, std::vector<TerminalInput>& out) {
  const auto due = deadline();
  if (!due || now < *due) return;
  if (state_ == State::kEscape) out.push_back(Key{.code = KeyCode::kEscape});
  if (state_ == State::kPaste && !paste_.empty()) out.push_back(Paste{std::move(paste_)});
  state_ = State::kGround;
}

void Keyboard::take(unsigned char byte, std::vector<TerminalInput>& out) {
  switch (state_) {
    case State::kGround:
      take_ground(byte, out);
      break;
    case State::kUtf8:
      take_utf8(byte, out);
      break;
    case State::kCsi:
      take_csi(byte, out);
      break;
    case State::kPaste:
      take_paste(byte, out);
      break;
    case State::kLinuxFunctionKey:
      state_ = State::kGround;
      break;
    case State::kSs3:
      take_ss3(byte, out);
      break;
    case State::kEscape:
      take_escaped(byte, out);
      break;
    case State::kString:
      take_string(byte, out);
      break;
    case State::kStringEscape:
      if (byte == '\\') {
        state_ = State::kGround;
        if (is_dcs_) decode_dcs(sequence_, out);
      } else {  // no end of a string: another sequence begins
        state_ = State::kEscape;
        take_escaped(byte, out);
      }
      break;
  }
}

void Keyboard::take_escaped(unsigned char byte, std::vector<TerminalInput>& out) {
  switch (byte) {
    case '[':
      sequence_.clear();
      overlong_ = false;
      state_ = State::kCsi;
      break;
    case 'O':
      state_ = State::kSs3;
      break;
    case 'P':  // DCS
    case ']':  // OSC
    case '_':  // APC
    case '^':  // PM
      sequence_.clear();
      is_dcs_ = byte == 'P';
      state_ = State::kString;
      break;
    default:  // the key itself, then another one: nothing here is bound to Alt
      state_ = State::kGround;
      out.push_back(Key{.code = KeyCode::kEscape});
      take_ground(byte, out);
      break;
  }
}

void Keyboard::take_ss3(unsigned char byte, std::vector<TerminalInput>& out) {
  state_ = State::kGround;
  if (const auto key = cursor_key(static_cast<char>(byte)))
    out.push_back(Key{.code = *key});
  else if (const char32_t typed = keypad_character(static_cast<char>(byte)))
    out.push_back(Key{.character = typed});
  else if (byte == 'M')
    out.push_back(Key{.code = KeyCode::kEnter});
  else if (byte == kEscapeByte)
    state_ = State::kEscape;
}

void Keyboard::take_string(unsigned char byte, std::vector<TerminalInput>& out) {
  constexpr unsigned char kBell = 0x07;  // ends an OSC, as some terminals write it
  if (byte == kEscapeByte) {
    state_ = State::kStringEscape;
  } else if (byte == kBell) {
    state_ = State::kGround;
  } else if (byte < 0x20) {  // no string of a terminal has one: a key, which counts
    state_ = State::kGround;
    take_ground(byte, out);
  } else if (sequence_.size() < kMaxStringBytes) {
    sequence_.push_back(static_cast<char>(byte));
  } else {
    state_ = State::kGround;
  }
}

void Keyboard::take_ground(unsigned char byte, std::vector<TerminalInput>& out) {
  if (byte == kEscapeByte) {
    state_ = State::kEscape;
  } else if (byte == '\r' || byte == '\n') {
    out.push_back(Key{.code = KeyCode::kEnter});
  } else if (byte == '\t') {
    out.push_back(Key{.code = KeyCode::kTab});
  } else if (byte == 0x7f || byte == 0x08) {
    out.push_back(Key{.code = KeyCode::kBackspace});
  } else if (byte >= 1 && byte <= 26) {
    out.push_back(Key{.character = static_cast<char32_t>('a' + byte - 1), .control = true});
  } else if (byte >= 0x20 && byte < 0x7f) {
    out.push_back(Key{.character = byte});
  } else if (byte >= 0xc2 && byte <= 0xf4) {
    missing_ = byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
    code_point_ = byte & (byte < 0xe0 ? 0x1fu : byte < 0xf0 ? 0x0fu : 0x07u);
    smallest_ = byte < 0xe0 ? 0x80 : byte < 0xf0 ? 0x800 : 0x10000;
    state_ = State::kUtf8;
  }
}

void Keyboard::take_utf8(unsigned char byte, std::vector<TerminalInput>& out) {
  if ((byte & 0xc0) != 0x80) {  // cut short: drop it, the byte begins something new
    state_ = State::kGround;
    take_ground(byte, out);
    return;
  }
  code_point_ = (code_point_ << 6) | (byte & 0x3fu);
  if (--missing_ > 0) return;
  state_ = State::kGround;
  const bool surrogate = code_point_ >= 0xd800 && code_point_ < 0xe000;
  const bool control = code_point_ < 0xa0;  // C1
  if (code_point_ < smallest_ || code_point_ > 0x10ffff || surrogate || control) return;
  out.push_back(Key{.character = code_point_});
}

void Keyboard::take_csi(unsigned char byte, std::vector<TerminalInput>& out) {
  if (byte == kEscapeByte) {
    state_ = State::kEscape;
  } else if (byte >= 0x40 && byte <= 0x7e) {
    state_ = State::kGround;
    if (byte == '[' && sequence_.empty()) {
      state_ = State::kLinuxFunctionKey;  // the Linux console's F1..F5: CSI [ A
    } else if (byte == '~' && sequence_ == "200") {
      paste_.clear();
      state_ = State::kPaste;
    } else if (!overlong_) {
      decode_csi(sequence_, static_cast<char>(byte), out);
    }
  } else if (byte >= 0x20) {
    if (sequence_.size() < kMaxSequenceBytes)
      sequence_.push_back(static_cast<char>(byte));
    else
      overlong_ = true;
  } else {
    state_ = State::kGround;  // a control byte inside a sequence: not ours, and the key it is counts
    take_ground(byte, out);
  }
}

void Keyboard::take_paste(unsigned char byte, std::vector<TerminalInput>& out) {
  paste_.push_back(static_cast<char>(byte));
  if (ends_with(paste_, kPasteEnd)) {
    paste_.resize(std::min(paste_.size() - kPasteEnd.size(), kMaxPasteBytes));
    out.push_back(Paste{std::move(paste_)});
    paste_.clear();
    state_ = State::kGround;
  } else if (paste_.size() > kMaxPasteBytes + kPasteEnd.size()) {
    // Keep the beginning, and the last bytes, which may be the end bracket's.
    paste_.erase(kMaxPasteBytes, 1);
  }
}

}  // namespace woodlouse::client
