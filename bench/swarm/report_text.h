// A line of a report.
#pragma once

#include <cstdio>
#include <string>

namespace woodlouse::swarm {

template <typename... Values>
std::string text(const char* format, Values... values) {
  char line[240];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

}  // namespace woodlouse::swarm
