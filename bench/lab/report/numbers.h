// Numbers from text: a list between commas, all of it or an error.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

namespace woodlouse::lab {

/// Exactly kCount finite numbers separated by commas, spaces around them allowed.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> numbers_of(std::string_view text) {
  std::array<double, kCount> result{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == kCount)) return std::nullopt;
    std::string_view field = text.substr(0, comma);
    const std::size_t first = field.find_first_not_of(" \t");
    if (first == std::string_view::npos) return std::nullopt;
    field = field.substr(first, field.find_last_not_of(" \t") + 1 - first);
    if (field.starts_with('+')) field.remove_prefix(1);
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), result[i]);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(result[i]))
      return std::nullopt;
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
  }
  return result;
}

}  // namespace woodlouse::lab
