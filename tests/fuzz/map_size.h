// Which maps a fuzz target builds: a function sampled at four million knots is a legal map, but takes
// seconds.
#pragma once

#include <string_view>

#include "shared/json/document.h"

namespace woodlouse::fuzz {

/// No JSON, or a map whose terrain does not ask for a fine grid of a function.
inline bool is_quick_map(std::string_view text) {
  constexpr std::uint64_t kMostKnots = 24, kFromHereRefused = 1000;
  const auto document = json::parse(text, {8, 100'000});
  if (!document) return true;
  const auto terrain = document->root().find("terrain");
  const auto grid = terrain ? terrain->find("grid") : std::nullopt;
  const auto number = grid ? grid->unsigned_integer() : std::nullopt;
  return !number || *number <= kMostKnots || *number >= kFromHereRefused;
}

}  // namespace woodlouse::fuzz
