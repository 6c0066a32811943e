// The `script` of a scenario file: rules, some of them repeated, laid out as events by step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/scenario/scenario.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"

namespace woodlouse::scenario {

inline constexpr std::uint64_t kMaxTicks = 1'000'000;  ///< of one scenario
inline constexpr std::uint64_t kMaxLice = 100'000;     ///< that join, over a scenario
inline constexpr std::size_t kMaxEvents = 1'000'000;   ///< of one scenario
/// Times that a rule of the script is due, whether somebody is there whom it is about or not.
inline constexpr std::size_t kMaxOccurrences = 1'000'000;

/// The events of steps before `last_tick`. `seed` draws the random thrusts. Reports what is wrong with a
/// rule, a player who is not there, and what comes after the last tick.
std::vector<Event> read_script(const json::Value& script, std::uint64_t last_tick, std::uint64_t seed,
                               json::Problems& problems);

}  // namespace woodlouse::scenario
