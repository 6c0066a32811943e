// How well the house's bots play: three skills, and what each of them can.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace woodlouse::server::bots {

enum class Skill : std::uint8_t { kEasy, kFair, kHard };

inline constexpr std::array kSkills = {Skill::kEasy, Skill::kFair, Skill::kHard};

constexpr std::string_view to_text(Skill skill) {
  switch (skill) {
    case Skill::kEasy:
      return "easy";
    case Skill::kHard:
      return "hard";
    case Skill::kFair:
      break;
  }
  return "fair";
}

constexpr std::optional<Skill> skill_from_text(std::string_view text) {
  for (const Skill skill : kSkills) {
    if (to_text(skill) == text) return skill;
  }
  return std::nullopt;
}

struct Ability {
  double reaction_s;        ///< what a bot acts on is at least as old [s]
  std::uint32_t decisions;  ///< a second
  double horizon_s;         ///< how far it looks ahead [s]
  std::size_t directions;   ///< in which it considers pushing
  double aim_error;         ///< its pushes are off by up to so much, to either side [rad]
  double power;             ///< the most it pushes with, of 1
};

constexpr Ability ability(Skill skill) {
  switch (skill) {
    case Skill::kEasy:
      return {0.40, 4, 2.0, 10, 0.22, 0.95};
    case Skill::kHard:
      return {0.15, 10, 3.0, 16, 0.03, 1.0};
    case Skill::kFair:
      break;
  }
  return {0.25, 5, 2.4, 12, 0.12, 0.98};
}

/// Of one among so many: a crowd looks less far and considers less, so that what it costs together stays what
/// kThinkers cost.
constexpr Ability in_crowd(Ability one, std::uint32_t bots) {
  constexpr std::uint32_t kThinkers = 32;
  if (bots <= kThinkers) return one;
  const double share = static_cast<double>(kThinkers) / bots;
  one.horizon_s = one.horizon_s * share > 0.8 ? one.horizon_s * share : 0.8;
  one.directions = one.directions > 8 ? 8 : one.directions;
  if (bots > 4 * kThinkers) one.directions = 4;
  return one;
}

}  // namespace woodlouse::server::bots
