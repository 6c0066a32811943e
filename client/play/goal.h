// What the rules of play want of you, in words: the lines over the map, and what is said of a ruling.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/play/roster.h"
#include "client/play/view_state.h"
#include "shared/map/map_definition.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// What the lines are made of. All of it outlives the call.
struct GoalFacts {
  const protocol::Welcome& welcome;
  const map::Map* map = nullptr;  ///< null until it has come
  const protocol::Game& game;     ///< whole
  const Roster& roster;
  const LouseSample* you = nullptr;  ///< null for a spectator, and while you are out
  double tick = 0.0;                 ///< the server's, now
};

/// One line or two of plain ASCII: phase and time left, your score or clock, the way to the next gate, place
/// or dearest crumb. In a podium the best three.
std::vector<std::string> goal_lines(const GoalFacts& facts);

/// Eight directions of the compass: "N", "NE" and so on; north is +y.
std::string compass(core::Vec2 way);
/// A span of moments: 1:23.456.
std::string span_text(std::int64_t moments, std::uint32_t tick_hz);

/// What an event of the rules is told as; empty: not worth a line. `you`: your louse, or 0.
std::string describe_ruling(const protocol::Event& event, std::uint32_t you, std::uint32_t tick_hz);

}  // namespace woodlouse::client
