// What the rules say happened in a step.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "shared/state/louse.h"

namespace woodlouse::rules {

/// When something happened, in 1/65536 of a tick since tick 0.
using Moment = std::uint64_t;
inline constexpr std::uint64_t kMomentsPerTick = 65536;

/// fraction: of the step from `tick`, 0..1.
constexpr Moment moment_of(std::uint64_t tick, double fraction) {
  return tick * kMomentsPerTick + static_cast<std::uint64_t>(65536.0 * fraction);
}

enum class EventKind : std::uint8_t {
  kGate,       ///< values: gate, lap, split [moments], delta to the own best lap's split [moments] or kNone
  kLap,        ///< values: lap, time [moments], whether it is the own best
  kRun,        ///< values: time [moments], rank, whether it began at rest on a spawn
  kCrumb,      ///< values: slot, value, chain, score
  kHarvest,    ///< of nobody: crumbs count twice from now on
  kBump,       ///< values: other louse, impulse [mm/s]
  kHolds,      ///< the louse holds the place alone; 0: nobody
  kContested,  ///< of nobody: several are on the place
  kMoving,     ///< of nobody; values: the place that will count, the tick from which it does
  kFell,       ///< left by an open edge; values: who bumped it, or 0
  kReturned,   ///< is back at a spawn
  kRound,      ///< of nobody; values: number, phase (round.h) that begins, the tick it ends at
};
inline constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();

/// "gate", as the wire has it.
std::string_view to_text(EventKind kind);

struct Event {
  EventKind kind = EventKind::kRound;
  state::LouseId louse = 0;  ///< 0: nobody's
  Moment moment = 0;
  std::array<std::int64_t, 4> values{};
  friend bool operator==(const Event&, const Event&) = default;
};

/// "78654321 gate 7 2 0 12345678 -65536": moment, kind, louse, and the values of its kind; - for kNone.
std::string to_text(const Event& event);

}  // namespace woodlouse::rules
