// What a mode of play shows besides the lice: its marks on the ground, its lines, what is told in big
// figures, its podium. Plain values, as scene.h; lengths in metres.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/vec2.h"

namespace woodlouse::client {

/// A race's gate, driven through from its right-hand side to its left, seen from a to b.
struct GateMark {
  core::Vec2 a, b;
  std::string label;  ///< "3"; of start and finish "S"
  bool is_next = false;
  bool in_air = false;  ///< counts only in flight
};

struct CrumbMark {
  core::Vec2 position;
  std::uint32_t value = 1;  ///< >= 1
  bool is_wanted = false;   ///< the line over the map leads to it
};

/// A place that is to be held.
struct RingMark {
  enum class State : std::uint8_t {
    kFree,
    kHeld,
    kContested,
    kComing,  ///< where it moves next
  };
  core::Vec2 at;
  double radius = 1.0;
  State state = State::kFree;
  std::uint32_t holder = 0;  ///< whose colour it has; 0: nobody's
};

/// A drive that was: an outline with a name.
struct GhostMark {
  std::string name;
  core::Vec2 position;
  core::Vec2 heading{1.0, 0.0};     ///< unit
  std::vector<core::Vec2> trail{};  ///< oldest first
};

/// How a piece of a line is meant; never told by colour alone.
enum class Tone : std::uint8_t { kUsual, kStrong, kDim, kGoal, kGood, kBad };

struct GoalSpan {
  std::string text;  ///< UTF-8: names stand in it
  Tone tone = Tone::kUsual;
  bool is_extra = false;  ///< left out first, where there is not room for all
};
using GoalLine = std::vector<GoalSpan>;
std::string plain_text(const GoalLine& line);

/// Big figures over the picture: digits, `+ - . : x` and blanks.
struct Splash {
  std::string text;
  Tone tone = Tone::kUsual;
};

/// Of the round's best three, first first.
struct PodiumStep {
  std::uint32_t id = 0;
  std::string name;
  bool is_you = false;
  std::string measure;
  std::string medal;  ///< "GOLD"; empty: none
};

struct Course {
  std::vector<GateMark> gates;
  std::vector<CrumbMark> crumbs;
  std::vector<RingMark> rings;
  std::vector<GhostMark> ghosts;
  std::optional<core::Vec2> target;  ///< where the arrow points: the next gate, the place, the dearest crumb
  core::Vec2 up{0.0, 1.0};           ///< what over the map points up in the picture, for the arrow's words
  std::vector<GoalLine> lines;       ///< above the map
  std::vector<GoalLine> lesson;      ///< below the map
  std::vector<std::string> rules;    ///< of the mode, for the help; at most 50 characters each
  std::optional<Splash> splash;
  std::vector<PodiumStep> podium;  ///< empty: the round goes on
  std::string podium_note;         ///< below it
  /// The slope that a full push climbs from rest; none: not known.
  std::optional<double> climbs;
};

inline std::string plain_text(const GoalLine& line) {
  std::string text;
  for (const GoalSpan& span : line) text += span.text;
  return text;
}

}  // namespace woodlouse::client
