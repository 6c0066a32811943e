#include "shared/protocol/text_cleaning.h"

#include <algorithm>
#include <array>

#include "shared/json/utf8.h"

namespace woodlouse::protocol {
namespace {

struct Span {
  char32_t first, last;
};

// White_Space of the Unicode character database, and the blanks that only look empty.
constexpr std::array kBlanks = {
    Span{0x09, 0x0d},     Span{0x20, 0x20},     Span{0x85, 0x85},     Span{0xa0, 0xa0},
    Span{0x115f, 0x1160}, Span{0x1680, 0x1680}, Span{0x2000, 0x200a}, Span{0x2028, 0x2029},
    Span{0x202f, 0x202f}, Span{0x205f, 0x205f}, Span{0x2800, 0x2800}, Span{0x3000, 0x3000},
    Span{0x3164, 0x3164}, Span{0xffa0, 0xffa0},
};

// Control characters, and of General_Category Cf and Default_Ignorable what is invisible or turns the
// writing.
constexpr std::array kRemoved = {
    Span{0x00, 0x1f},       Span{0x7f, 0x9f},     Span{0xad, 0xad},       Span{0x034f, 0x034f},
    Span{0x061c, 0x061c},   Span{0x17b4, 0x17b5}, Span{0x180b, 0x180f},   Span{0x200b, 0x200f},
    Span{0x202a, 0x202e},   Span{0x2060, 0x206f}, Span{0xfe00, 0xfe0f},   Span{0xfeff, 0xfeff},
    Span{0xfff0, 0xfffb},   Span{0xfffe, 0xffff}, Span{0x1bca0, 0x1bca3}, Span{0x1d173, 0x1d17a},
    Span{0xe0000, 0xe0fff},
};

template <std::size_t N>
bool contains(const std::array<Span, N>& spans, char32_t c) {
  return std::any_of(spans.begin(), spans.end(), [c](Span s) { return c >= s.first && c <= s.last; });
}

}  // namespace

std::string clean_text(std::string_view text, std::size_t max_bytes) {
  std::string out;
  bool blank = false;  // one is due before the next character, unless that is the first
  while (!text.empty()) {
    const json::Utf8Character character = json::first_character(text);
    const std::string_view bytes = text.substr(0, character.size);
    text.remove_prefix(character.size);
    if (!character.valid) continue;
    if (contains(kBlanks, character.code)) {
      blank = !out.empty();
      continue;
    }
    if (contains(kRemoved, character.code)) continue;
    if (out.size() + (blank ? 1 : 0) + bytes.size() > max_bytes) break;
    if (blank) out += ' ';
    blank = false;
    out += bytes;
  }
  return out;
}

}  // namespace woodlouse::protocol
