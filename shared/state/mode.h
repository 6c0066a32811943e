// What is played in a room: by which rules, if by any.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace woodlouse::state {

enum class Mode : std::uint8_t {
  kRoam,    ///< no rules: drive
  kRace,    ///< through gates, against the clock
  kForage,  ///< crumbs that are eaten once, by the first
  kHill,    ///< a place that is held alone; lice bump
};

inline constexpr std::array kModes = {Mode::kRoam, Mode::kRace, Mode::kForage, Mode::kHill};

constexpr std::string_view to_text(Mode mode) {
  switch (mode) {
    case Mode::kRace:
      return "race";
    case Mode::kForage:
      return "forage";
    case Mode::kHill:
      return "hill";
    case Mode::kRoam:
      break;
  }
  return "roam";
}

constexpr std::optional<Mode> mode_from_text(std::string_view text) {
  for (const Mode mode : kModes) {
    if (to_text(mode) == text) return mode;
  }
  return std::nullopt;
}

}  // namespace woodlouse::state
