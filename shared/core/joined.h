// Builds a message of parts.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace woodlouse::core {

/// The parts one after the other.
inline std::string joined(std::initializer_list<std::string_view> parts) {
  std::string result;
  for (const std::string_view part : parts) result += part;
  return result;
}

}  // namespace woodlouse::core
