// Long lines in narrow boxes.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "client/cells/character_width.h"

namespace woodlouse::client {

/// `text` in lines of at most `width` >= 1 columns, broken at blanks where there are any; later lines are
/// indented by two columns where width allows.
inline std::vector<std::u32string> wrapped(std::u32string text, int width) {
  std::vector<std::u32string> lines;
  const auto room = static_cast<std::size_t>(width);
  while (text.size() > room) {
    std::size_t cut = text.rfind(U' ', room);
    const std::size_t indent = lines.empty() ? 0 : 2;
    if (cut == std::u32string::npos || cut <= indent) cut = room;
    if (text[cut] == kWideTail && cut > 1) --cut;  // a wide character stays whole
    lines.push_back(text.substr(0, cut));
    text.erase(0, cut);
    text.erase(0, text.find_first_not_of(U' '));
    if (width > 8) text.insert(0, 2, U' ');
  }
  lines.push_back(std::move(text));
  return lines;
}

}  // namespace woodlouse::client
