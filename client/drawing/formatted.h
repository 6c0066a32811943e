// printf into a std::string, for lines of a panel.
#pragma once

#include <cstdio>
#include <string>

namespace woodlouse::client {

/// At most 159 characters.
template <typename... Values>
std::string formatted(const char* pattern, Values... values) {
  char text[160];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace woodlouse::client
