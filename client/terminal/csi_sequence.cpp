#include "client/terminal/csi_sequence.h"

#include <array>
#include <charconv>
#include <cstddef>

namespace woodlouse::client {
namespace {

constexpr std::size_t kMaxFields = 4;
constexpr std::size_t kMaxSubfields = 8;

/// "97:65;5:3" as numbers; a missing one is 0.
struct Parameters {
  std::array<std::array<unsigned, kMaxSubfields>, kMaxFields> value{};
  std::array<std::size_t, kMaxFields> subfields{};
  std::size_t fields = 0;
};

Parameters split(std::string_view text) {
  Parameters result;
  while (result.fields < kMaxFields) {
    const std::size_t end = text.find(';');
    std::string_view field = text.substr(0, end);
    std::size_t count = 0;
    while (count < kMaxSubfields) {
      const std::size_t colon = field.find(':');
      const std::string_view number = field.substr(0, colon);
      unsigned value = 0;
      std::from_chars(number.data(), number.data() + number.size(), value);
      result.value[result.fields][count++] = value;
      if (colon == std::string_view::npos) break;
      field.remove_prefix(colon + 1);
    }
    result.subfields[result.fields++] = count;
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return result;
}

// xterm and kitty send the modifiers as a bit set plus 1: shift 1, alt 2, control 4.
constexpr unsigned kShift = 1;
constexpr unsigned kAlt = 2;
constexpr unsigned kControl = 4;

struct Modifiers {
  unsigned bits = 0;
  KeyAction action = KeyAction::kPress;
};

Modifiers modifiers(const Parameters& parameters) {
  Modifiers result;
  const unsigned sent = parameters.value[1][0];
  result.bits = sent > 0 ? sent - 1 : 0;
  if (parameters.value[1][1] == 2) result.action = KeyAction::kRepeat;
  if (parameters.value[1][1] == 3) result.action = KeyAction::kRelease;
  return result;
}

Key special(KeyCode code, const Modifiers& held) {
  return {.code = code,
          .control = (held.bits & kControl) != 0,
          .alt = (held.bits & kAlt) != 0,
          .action = held.action};
}

std::optional<KeyCode> numbered_key(unsigned number) {
  switch (number) {
    case 1:
    case 7:
      return KeyCode::kHome;
    case 3:
      return KeyCode::kDelete;
    case 4:
    case 8:
      return KeyCode::kEnd;
    case 5:
      return KeyCode::kPageUp;
    case 6:
      return KeyCode::kPageDown;
    default:
      return std::nullopt;
  }
}

std::optional<KeyCode> named_code_point(unsigned code) {
  switch (code) {
    case 9:
      return KeyCode::kTab;
    case 13:
    case 57414:
      return KeyCode::kEnter;  // 57414: the number pad's
    case 27:
      return KeyCode::kEscape;
    case 8:
    case 127:
      return KeyCode::kBackspace;
    case 57417:
      return KeyCode::kLeft;  // number pad without num lock
    case 57418:
      return KeyCode::kRight;
    case 57419:
      return KeyCode::kUp;
    case 57420:
      return KeyCode::kDown;
    default:
      return std::nullopt;
  }
}

/// Of the number pad in kitty's numbers, where num lock has them type.
char32_t kitty_keypad_character(unsigned code) {
  constexpr unsigned kZero = 57399;
  constexpr std::u32string_view kTyped = U"0123456789./*-+";
  if (code >= kZero && code < kZero + kTyped.size()) return kTyped[code - kZero];
  return code == 57415 ? U'=' : code == 57416 ? U',' : 0;
}

bool is_typed(unsigned code) {
  const bool functional =
      code >= 57344 && code <= 63743;  // kitty's private-use numbers: modifiers, F-keys, media
  return code >= 0x20 && code != 0x7f && !functional && code <= 0x10ffff &&
         !(code >= 0xd800 && code < 0xe000);
}

char32_t shifted(const Parameters& parameters, unsigned bits) {
  const unsigned code = parameters.value[0][0];
  if ((bits & kShift) == 0) return code;
  if (is_typed(parameters.value[0][1])) return parameters.value[0][1];
  return code >= 'a' && code <= 'z' ? code - ('a' - 'A') : code;
}

void decode_kitty(const Parameters& parameters, std::vector<TerminalInput>& out) {
  const Modifiers held = modifiers(parameters);
  const unsigned code = parameters.value[0][0];
  if (const auto name = named_code_point(code)) {
    out.push_back(special(*name, held));
    return;
  }
  Key key = special(KeyCode::kCharacter, held);
  if (const char32_t typed = kitty_keypad_character(code)) {
    key.character = typed;
    out.push_back(key);
    return;
  }
  if (code != 0 && !is_typed(code)) return;
  key.physical = is_typed(parameters.value[0][2]) ? parameters.value[0][2] : 0;
  // The associated text is what the keyboard layout made of it; an input method may send several.
  const bool has_text = parameters.fields > 2 && is_typed(parameters.value[2][0]);
  if (!has_text) {
    key.character = key.control ? code : shifted(parameters, held.bits);
    if (key.character != 0) out.push_back(key);
    return;
  }
  for (std::size_t i = 0; i < parameters.subfields[2]; ++i) {
    if (!is_typed(parameters.value[2][i])) continue;
    key.character = parameters.value[2][i];
    out.push_back(key);
  }
}

}  // namespace

std::optional<KeyCode> cursor_key(char final) {
  switch (final) {
    case 'A':
      return KeyCode::kUp;
    case 'B':
      return KeyCode::kDown;
    case 'C':
      return KeyCode::kRight;
    case 'D':
      return KeyCode::kLeft;
    case 'H':
      return KeyCode::kHome;
    case 'F':
      return KeyCode::kEnd;
    default:
      return std::nullopt;
  }
}

char32_t keypad_character(char final) {
  constexpr std::u32string_view kTyped = U"*+,-./0123456789";
  if (final == 'X') return U'=';
  return final >= 'j' && final <= 'y' ? kTyped[static_cast<std::size_t>(final - 'j')] : 0;
}

void decode_dcs(std::string_view text, std::vector<TerminalInput>& out) {
  const bool is_known = text.starts_with("1$r");
  if (is_known || text.starts_with("0$r"))
    out.push_back(SettingReport{is_known, std::string(text.substr(3))});
}

void decode_csi(std::string_view text, char final, std::vector<TerminalInput>& out) {
  if (!text.empty() && text.front() == '?') {
    if (final == 'u') out.push_back(KittyFlags{split(text.substr(1)).value[0][0]});
    if (final == 'c') out.push_back(DeviceAttributes{});
    if (final == 'y' && text.back() == '$') {
      const Parameters report = split(text.substr(1));
      out.push_back(ModeReport{report.value[0][0], report.value[1][0]});
    }
    return;
  }
  if (!text.empty() && (text.front() < '0' || text.front() > ';'))
    return;  // private parameters: nobody's key
  const Parameters parameters = split(text);
  if (const auto key = cursor_key(final)) {
    out.push_back(special(*key, modifiers(parameters)));
  } else if (final == '~') {
    if (const auto numbered = numbered_key(parameters.value[0][0])) {
      out.push_back(special(*numbered, modifiers(parameters)));
    }
  } else if (final == 'u') {
    decode_kitty(parameters, out);
  } else if (final == 'R' && parameters.fields == 2) {
    out.push_back(CursorReport{parameters.value[0][0], parameters.value[1][0]});
  } else if (final == 'Z') {
    out.push_back(Key{.code = KeyCode::kTab});
  } else if (text.empty() && (final == 'I' || final == 'O')) {
    out.push_back(final == 'I' ? Focus::kGained : Focus::kLost);
  }
}

}  // namespace woodlouse::client
