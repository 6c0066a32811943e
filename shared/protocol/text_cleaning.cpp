#include "shared/protocol/text_cleaning.h"

#include <algorithm>
#include <array>

#include "shared/core/printable.h"
#include "shared/core/utf8.h"
#include "shared/protocol/combining_marks.h"

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

constexpr int kMaxMarks = 2;  // over one character

bool is_blank(char32_t c) {
  return std::any_of(kBlanks.begin(), kBlanks.end(), [c](Span s) { return c >= s.first && c <= s.last; });
}

}  // namespace

std::string clean_text(std::string_view text, std::size_t max_bytes) {
  std::string out;
  int marks = 0;       // running
  bool blank = false;  // one is due before the next character, unless that is the first
  while (!text.empty()) {
    const core::Utf8Character character = core::first_character(text);
    const std::string_view bytes = text.substr(0, character.size);
    text.remove_prefix(character.size);
    if (!character.valid) continue;
    if (is_blank(character.code)) {
      blank = !out.empty();
      continue;
    }
    if (!core::is_printable(character.code)) continue;
    marks = is_combining_mark(character.code) ? marks + 1 : 0;
    if (marks > kMaxMarks) continue;
    if (out.size() + (blank ? 1 : 0) + bytes.size() > max_bytes) break;
    if (blank) out += ' ';
    blank = false;
    out += bytes;
  }
  return out;
}

}  // namespace woodlouse::protocol
