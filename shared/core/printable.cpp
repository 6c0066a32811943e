#include "shared/core/printable.h"

#include <algorithm>
#include <array>

#include "shared/core/utf8.h"

namespace woodlouse::core {
namespace {

struct CodeSpan {
  char32_t first, last;
};

// Beside control characters: the line and paragraph separators, and of General_Category Cf and
// Default_Ignorable of the Unicode character database what is invisible or turns the writing.
constexpr std::array kUnprintable = {
    CodeSpan{0xad, 0xad},       CodeSpan{0x034f, 0x034f},   CodeSpan{0x061c, 0x061c},
    CodeSpan{0x17b4, 0x17b5},   CodeSpan{0x180b, 0x180f},   CodeSpan{0x200b, 0x200f},
    CodeSpan{0x2028, 0x202e},   CodeSpan{0x2060, 0x206f},   CodeSpan{0xfe00, 0xfe0f},
    CodeSpan{0xfeff, 0xfeff},   CodeSpan{0xfff0, 0xfffb},   CodeSpan{0xfffe, 0xffff},
    CodeSpan{0x1bca0, 0x1bca3}, CodeSpan{0x1d173, 0x1d17a}, CodeSpan{0xe0000, 0xe0fff},
};

}  // namespace

bool is_printable(char32_t code) {
  if (is_control(code)) return false;
  return std::none_of(kUnprintable.begin(), kUnprintable.end(),
                      [code](CodeSpan span) { return code >= span.first && code <= span.last; });
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    if (character.valid && is_printable(character.code)) {
      out += text.substr(0, character.size);
    } else {
      out += '?';
    }
    text.remove_prefix(character.size);
  }
  return out;
}

}  // namespace woodlouse::core
