// What the rules of play want of you, in words: the lines over the map.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/drawing/course/course.h"
#include "client/play/modes/own_run.h"
#include "client/play/modes/way_words.h"
#include "client/play/visible_lice.h"

namespace woodlouse::client {

/// Of whom and of what the lines tell. All of it outlives the call.
struct GoalFacts {
  const Sight& sight;
  std::uint32_t id = 0;              ///< whose goal; 0: nobody's
  const LouseSample* you = nullptr;  ///< null where there is none, and while it is out
  bool is_own = false;               ///< it is yours, not one that you watch
  const OwnRun* run = nullptr;       ///< of your own louse
  int rank = 0;                      ///< 0: none
  core::Vec2 up{0.0, 1.0};           ///< what over the map points up in the picture; length 1
  Winds winds = Winds::kShort;
};

/// One line or two: phase and time left, score or clock, the way to the next gate, place or dearest crumb. In
/// a podium the first alone. Empty where there are no rules, or nothing of them was shown yet.
std::vector<GoalLine> goal_lines(const GoalFacts& facts);

/// Where that way leads, as seen from the louse where edges wrap; none: nowhere.
std::optional<core::Vec2> goal_of(const GoalFacts& facts);

/// What forage wants first, of the dearest crumbs the nearest; null: there is none. REQUIRES you, rules and a
/// map.
const protocol::GameCrumb* dearest_crumb(const GoalFacts& facts);
/// What a gate is called: "gate S", where laps begin, "gate 3".
std::string gate_name(std::int64_t gate);
/// A span of moments: 1:23.456.
std::string span_text(std::int64_t moments, std::uint32_t tick_hz);
/// A score as a mode counts it: "1:02.345", "12", "13.4 s"; "--" where there is none yet.
std::string score_text(state::Mode mode, std::int64_t score, std::uint32_t tick_hz);

/// What a welcome's `rules` say of it; 0: nothing that can be one.
std::uint64_t author_ms_of(const std::string& rules);

/// Which medal a run of a race with this author's time deserves: "AUTHOR", "GOLD", "SILVER", "BRONZE"; empty:
/// none. moments > 0.
std::string medal_of(std::uint64_t author_ms, std::int64_t moments, std::uint32_t tick_hz);

}  // namespace woodlouse::client
